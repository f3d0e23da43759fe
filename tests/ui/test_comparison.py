"""Two sessions on the screen: sentences for hands and days, mirrored pictures, what is said where nothing is judged."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pytestqt.qtbot import QtBot

from carpus.core.results.ranges import progress_keys
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import SessionPair, compare_pair
from carpus.ui.kit.background import Background
from carpus.ui.kit.table import cell_text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.comparison.screen import ComparisonScreen, difference_table, facts_words, headline, warning_words
from tests.ui.conftest import Show
from tests.ui.fakes import NOW, FakeSessions, figures_once, session
from tests.ui.hand_fakes import hand_session


@pytest.fixture(scope="module")
def right() -> SessionResults:
    return figures_once(session(), RepetitionChoices({6: "pain"}))


@pytest.fixture(scope="module")
def left() -> SessionResults:
    return figures_once(session(NOW, 1.25, session_id="left", side="left"))


def lines_of(both: SessionPair) -> dict[str, list[str]]:
    rows = ([cell_text(cell) for cell in row] for row in difference_table(both).rows)
    return {row[0]: row for row in rows}


def test_comparison_headline_of_two_hands_names_the_hand_that_moves_less(
    right: SessionResults, left: SessionResults
) -> None:
    assert headline(compare_pair(right, left))[0] == "Total arc: 23° less on the right than on the left."
    assert headline(compare_pair(left, right))[0] == "Total arc: 23° more on the left than on the right."
    sentence, note = headline(compare_pair(right, replace(right, side="left")))
    assert sentence == "No difference beyond measurement error between right and left."
    assert "not a norm" in note
    both = compare_pair(right, left)
    words = {name: row[-1] for name, row in lines_of(both).items()}
    assert words["Total arc"] == "23° less, beyond MDC (14°)"
    assert words["Extension"].endswith("beyond MDC (10°)")
    assert facts_words(both).startswith(
        "Right: mean of 8 repetitions; repetition 7 excluded: pain; "
        "repetition 10 excluded: cut off at the end of the recording; "
        "Left: mean of 9 repetitions; repetition 10 excluded: cut off at the end of the recording. Until the clinic"
    )


def test_comparison_of_fingers_partly_occluded_shows_a_lower_bound() -> None:
    few = figures_once(hand_session(share=0.55, session_id="hand-right"))
    hidden = figures_once(hand_session(session_id="hand-left", side="left"))
    both = compare_pair(few, hidden, progress_keys("tam"))
    assert headline(both)[0].endswith("less on the right than on the left.")
    rows = lines_of(both)
    assert rows["Middle finger, TAM"][2].startswith("≥")
    assert rows["Middle finger, TAM"][3].startswith("at least")
    assert rows["Index finger, TAM"][3] == "not compared: partly occluded"


def test_comparison_not_comparable_states_the_reason_once_and_no_assessment(
    right: SessionResults, left: SessionResults
) -> None:
    both = compare_pair(right, replace(left, quality=replace(left.quality, distance_m=0.95)))
    assert headline(both) == ("The sessions are shown side by side, but not compared.", "")
    assert "the camera was at another distance" in warning_words(both)
    rows = lines_of(both)
    assert not any(one.is_beyond_error for one in both.ranges)
    assert rows["Total arc"][3] == "23° less", "the values are shown"


def test_comparison_left_hand_is_mirrored_next_to_a_right_one_and_labelled(
    qtbot: QtBot, theme: Theme, show: Show[ComparisonScreen], background: Background
) -> None:
    screen = show(ComparisonScreen(theme, background, FakeSessions(pictures=False)))
    screen.load_sessions(("session-left", "session-7"), "right")
    qtbot.waitUntil(lambda: screen.comparison is not None)
    assert screen.session_ids == ("session-7", "session-left"), "the affected hand first"
    qtbot.waitUntil(lambda: all(picture.image is not None for picture in screen.frame_views))
    first, second = screen.frame_views
    assert (first.is_mirrored, second.is_mirrored) == (False, True)
    assert "unaffected · mirrored" in screen.frame_labels[1].text()
    screen.slider.time_chosen.emit(30.0)
    assert screen.playing.time_s == pytest.approx(30.0, abs=1e-6)
    screen.load_sessions(("session-7", "session-6"))
    qtbot.waitUntil(lambda: screen.comparison is not None)
    assert not any(view.is_mirrored for view in screen.frame_views), "there is no left hand"
