"""Two sessions on the screen: sentences for hands and days, mirrored pictures, what is said where nothing is judged."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.results.figures import SessionFigures
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.side_by_side import SideBySide, side_by_side
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.beside.words import difference_table, facts_words, headline, keys_of, kinds, unfair_words
from carpus.ui.theme import Theme
from carpus.ui.words.fingers import followed_keys
from carpus.ui.words.table import cell_words
from tests.ui.conftest import Show
from tests.ui.fakes import NOW, FakeSessions, figures_once, session
from tests.ui.hand_fakes import hand_session


@pytest.fixture(scope="module")
def right() -> SessionFigures:
    return figures_once(session(), RepetitionChoices({6: "pain"}))


@pytest.fixture(scope="module")
def left() -> SessionFigures:
    return figures_once(session(NOW, 1.25, session_id="left", side="left"))


def lines_of(both: SideBySide) -> dict[str, list[str]]:
    rows = ([cell_words(cell) for cell in row] for row in difference_table(both).rows)
    return {row[0]: row for row in rows}


def test_the_sentence_names_the_hand_that_moves_less(right: SessionFigures, left: SessionFigures) -> None:
    assert headline(side_by_side(right, left))[0] == "Whole arc: 23° less on the right than on the left."
    assert headline(side_by_side(left, right))[0] == "Whole arc: 23° more on the left than on the right."
    sentence, basis = headline(side_by_side(right, replace(right, side="left")))
    assert sentence == "No difference beyond measurement error between right and left."
    assert "within the measurement error of 14°" in basis
    both = side_by_side(right, left)
    words = {name: row[-1] for name, row in lines_of(both).items()}
    assert words["Whole arc"] == "less than the left, beyond error"
    assert words["Extension"] == "less than the left, beyond error"
    assert facts_words(both) == (
        "same exercise, same day, same set-up; "
        "Right: mean of 8 repetitions; number 7 left out: pain; number 10 left out: the recording ended in it; "
        "Left: mean of 9 repetitions; number 10 left out: the recording ended in it"
    )


def test_of_fingers_a_lower_bound_is_said_to_be_one() -> None:
    few = figures_once(hand_session(share=0.55, session_id="hand-right"))
    hidden = figures_once(hand_session(session_id="hand-left", side="left"))
    both = side_by_side(few, hidden, followed_keys("tam"))
    assert headline(both)[0].endswith("less on the right than on the left.")
    rows = lines_of(both)
    assert rows["Middle finger, TAM"][2].startswith("≥")
    assert rows["Middle finger, TAM"][3].startswith("at least")
    assert rows["Index finger, TAM"][5] == "not judged: hidden in part"
    assert rows["Index finger, TAM"][3] == "–"


def test_of_a_hook_the_middle_joints_of_all_fingers_come_first() -> None:
    hands = [
        hand_session(session_id=side, side=side, exercise="FIST_HOOK", motion="hook") for side in ("right", "left")
    ]
    first, second = map(figures_once, hands)
    offered = [value for value, _ in kinds(first, second)]
    assert offered[:2] == ["middle", "1"]
    both = side_by_side(first, second, keys_of(offered[0]))
    assert [one.after.of for one in both.ranges] == [f"PIP{finger}_flexion" for finger in (2, 3, 4, 5)]


def test_an_unfair_pair_has_its_reason_once_and_no_judgement(right: SessionFigures, left: SessionFigures) -> None:
    both = side_by_side(right, replace(left, quality=replace(left.quality, distance_m=0.95)))
    assert headline(both) == ("Shown beside each other, not judged.", "")
    assert "the camera was at another distance" in unfair_words(both)
    rows = lines_of(both)
    assert {row[5] for row in rows.values()} == {"not judged"}
    assert not any(one.is_beyond for one in both.ranges)
    assert rows["Whole arc"][3] == "23° less", "the values are shown"


def test_the_left_hand_is_mirrored_and_says_so_until_m(
    qtbot: QtBot, theme: Theme, show: Show[BesideScreen], background: Background
) -> None:
    screen = show(BesideScreen(theme, background, FakeSessions(pictures=False)))
    screen.begin(("session-left", "session-7"), "right")
    qtbot.waitUntil(lambda: screen.both is not None)
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
    qtbot.waitUntil(lambda: screen.both is not None)
    assert not screen.differences.mirror_button.isVisible(), "there is no left hand"
