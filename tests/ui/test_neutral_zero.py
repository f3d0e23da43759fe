"""Ranges of the wrist by the neutral-zero method."""

from __future__ import annotations

from dataclasses import replace

import pytest

from carpus.core.model.hand.exercises import DIRECTIONS
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measure import summarise_values
from carpus.ui.words.ranges import neutral_zero_words
from tests.ui.fakes import figures_once, session


@pytest.mark.parametrize(
    ("ends", "hidden", "words"),
    [
        ({"extension": 54.6, "flexion": 52.0}, "", "S 55-0-52"),
        ({"extension": -10.0, "flexion": 52.0}, "", "S 0-10-52"),  # neutral is not reached
        ({"extension": 55.0, "flexion": -8.0}, "", "S 55-8-0"),
        ({"extension": 0.0, "flexion": 52.0}, "", "S 0-0-52"),
        ({"radial": 20.0, "ulnar": 30.0}, "ulnar", "F 20-0-≥30"),
        ({"supination": 80.0}, "", ""),
    ],
)
def test_neutral_zero_has_zero_at_its_place_and_marks_a_lower_bound(
    ends: dict[str, float], hidden: str, words: str
) -> None:
    angle = next(number for number, names in enumerate(DIRECTIONS) if set(ends) <= set(names))
    rows = [
        replace(summarise_values("range", WRIST_ANGLES[angle], end, "deg", (mean,)), is_lower_bound=end == hidden)
        for end, mean in ends.items()
    ]
    results = replace(figures_once(session()), measures=tuple(rows))
    assert neutral_zero_words(results, angle).replace("\N{NON-BREAKING HYPHEN}", "-") == words
