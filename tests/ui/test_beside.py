"""Two sessions on the screen: sentences for hands and days, mirrored pictures, what is said where nothing is judged."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.results.figures import SessionFigures
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.side_by_side import side_by_side
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.keys import Keys
from carpus.ui.report.beside_shown import Watched, kinds, shown
from carpus.ui.report.beside_words import facts_words, headline, table_rows, unfair_words
from carpus.ui.report.hand_rows import followed_keys
from carpus.ui.theme import Theme
from tests.ui.conftest import Show
from tests.ui.fakes import NOW, FakeSessions, figures_once, session
from tests.ui.hand_fakes import hand_session


@pytest.fixture(scope="module")
def right() -> SessionFigures:
    return figures_once(session(), RepetitionChoices({6: "pain"}))


@pytest.fixture(scope="module")
def left() -> SessionFigures:
    return figures_once(session(NOW, 1.25, session_id="left", side="left"))


def hands(**look: str) -> list[Watched]:
    """A right and a left one that do the same."""
    both = [hand_session(session_id=side, side=side, **look) for side in ("right", "left")]
    return [Watched.of(hand, figures_once(hand)) for hand in both]


def test_the_sentence_names_the_hand_that_moves_less(right: SessionFigures, left: SessionFigures) -> None:
    assert headline(side_by_side(right, left))[0] == "The right wrist moves 23° less than the left."
    assert headline(side_by_side(left, right))[0] == "The left wrist moves 23° more than the right."
    sentence, basis = headline(side_by_side(right, replace(right, side="left")))
    assert sentence == "No difference beyond measurement error between right and left."
    assert "within the measurement error of 14°" in basis
    both = side_by_side(right, left)
    words = {row.movement: row.words for row in table_rows(both, whole_hand=False)}
    assert words["Whole arc"] == "less than the left, beyond error"
    assert words["Extension"] == "less than the left, just beyond error"
    assert words["Peak speed"] == words["Side movement"] == "not judged: no error limit is known"
    assert facts_words(both) == (
        "same exercise, same day, same set-up; "
        "Right: mean of 8 repetitions; number 7 left out: pain; number 10 left out: the recording ended in it; "
        "Left: mean of 9 repetitions; number 10 left out: the recording ended in it"
    )


def test_fingers_are_counted_and_a_lower_bound_is_said_to_be_one() -> None:
    few = figures_once(hand_session(share=0.55, session_id="hand-right"))
    hidden = figures_once(hand_session(session_id="hand-left", side="left"))
    both = side_by_side(few, hidden, followed_keys("tam"))
    assert headline(both)[0] == "TAM is less on the right than on the left in 4 of 5 fingers."
    rows = {row.movement: row for row in table_rows(both, whole_hand=True)}
    assert rows["Middle finger, TAM"].second.startswith("≥")
    assert rows["Middle finger, TAM"].difference.startswith("at least")
    assert rows["Index finger, TAM"].words == "not judged: hidden in part"
    assert rows["Index finger, TAM"].difference == "–"


def test_of_a_hook_all_middle_joints_come_first_and_what_nobody_measures_has_no_curve() -> None:
    first, second = hands(exercise="FIST_HOOK", motion="hook")
    offered = [value for value, _ in kinds(first, second)]
    assert offered[:2] == ["middle", "1"]
    now = shown(first, second, offered[0])
    assert [one.first.joint for one in now.both.ranges] == [f"PIP{finger}_flexion" for finger in (2, 3, 4, 5)]
    finger = shown(first, second, "3")
    assert ("PIP3_flexion", -1) in finger.quantities
    assert ("DIP3_flexion", -1) not in finger.quantities


def test_the_curve_is_of_the_finger_that_was_looked_at() -> None:
    now = shown(*hands(), "tam")
    assert now.quantity_of(4) == ("TAM4", -1)
    assert now.quantity_of(0) == now.main_quantity
    assert replace(now, both=replace(now.both, ranges=())).main_quantity == ("TAM3", -1), "as the exercise says"


def test_an_unfair_pair_has_its_reason_once_and_no_judgement(right: SessionFigures, left: SessionFigures) -> None:
    both = side_by_side(right, replace(left, quality=replace(left.quality, distance_m=0.95)))
    assert headline(both) == ("Shown beside each other, not judged.", "")
    assert "the camera was at another distance" in unfair_words(both)
    rows = table_rows(both, whole_hand=False)
    assert {row.words for row in rows} == {"not judged"}
    assert not any(row.strong for row in rows)
    assert rows[0].difference == "23° less", "the figures are shown"


def test_the_left_hand_is_mirrored_and_says_so_until_m(
    qtbot: QtBot, theme: Theme, show: Show[BesideScreen], background: Background
) -> None:
    screen = show(BesideScreen(theme, Keys(), background, FakeSessions(pictures=False)))
    screen.begin(("session-left", "session-7"), "right")
    qtbot.waitUntil(lambda: screen.shown is not None)
    assert screen.ids == ("session-7", "session-left"), "the affected hand first"
    qtbot.waitUntil(lambda: all(picture.image is not None for picture in screen.pictures))
    first, second = screen.pictures
    assert (first.mirrored, second.mirrored) == (False, True)
    assert second.name.endswith("healthy · mirrored")
    qtbot.keyClick(screen, Qt.Key.Key_M)
    assert not second.mirrored
    assert "mirrored" not in second.name
    screen.player.tracks[1].sought.emit(30.0)  # pointed at in the second one's track
    assert screen.together.step.at(screen.playing.time_s)[1] == pytest.approx(30.0, abs=1e-6)
    screen.begin(("session-7", "session-6"))
    qtbot.waitUntil(lambda: screen.shown is not None)
    assert not screen.differences.mirror_button.isVisible(), "there is no left hand"
