"""Ranges of the wrist by the neutral-zero method."""

from __future__ import annotations

from dataclasses import replace

import pytest

from carpus.core.results.measure import Measure, summarise_values
from carpus.core.results.session_results import SessionResults
from carpus.ui.words.ranges import neutral_zero_words
from tests.ui.fakes import figures_once, session


def results_with(*ends: tuple[str, str, float]) -> SessionResults:
    """Return results with these ends (angle, movement, mean in degrees) as the only measures."""
    rows = [summarise_values("range", subject, movement, "deg", (mean,)) for subject, movement, mean in ends]
    return replace(figures_once(session()), measures=tuple(rows))


@pytest.mark.parametrize(
    ("extension_deg", "flexion_deg", "words"),
    [(54.6, 52.0, "S 55-0-52"), (-10.0, 52.0, "S 0-10-52"), (55.0, -8.0, "S 55-8-0"), (0.0, 52.0, "S 0-0-52")],
)
def test_neutral_zero_with_and_without_neutral_has_zero_at_its_place(
    extension_deg: float, flexion_deg: float, words: str
) -> None:
    results = results_with(("flexion", "extension", extension_deg), ("flexion", "flexion", flexion_deg))

    assert neutral_zero_words(results, 1).replace("\N{NON-BREAKING HYPHEN}", "-") == words


def test_neutral_zero_of_an_end_that_was_hidden_is_a_lower_bound() -> None:
    results = results_with(("deviation", "radial", 20.0), ("deviation", "ulnar", 30.0))
    hidden: tuple[Measure, ...] = (results.measures[0], replace(results.measures[1], is_lower_bound=True))

    assert neutral_zero_words(replace(results, measures=hidden), 0).endswith("≥30")


def test_neutral_zero_with_one_end_is_empty() -> None:
    assert neutral_zero_words(results_with(("pronosupination", "supination", 80.0)), 2) == ""
