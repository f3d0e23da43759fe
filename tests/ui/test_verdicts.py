"""One sentence for what is not beyond the error, and nothing said of a still hand but that it is still."""

from __future__ import annotations

import ast
import math
from dataclasses import replace
from datetime import datetime, timedelta

import pytest

from carpus.core.hand.exercises import exercise_named
from carpus.ui import numbers
from carpus.ui.figures import figure_of
from carpus.ui.live.number_card import speed_words
from carpus.ui.report.hand_rows import compared_figures
from carpus.ui.report.main_figure import main_figure
from carpus.ui.report.pdf import session_report
from carpus.ui.report.screen import suggested_name
from carpus.ui.verdicts import change_since_first, difference, no_change_words, verdict_word
from tests.sources import SOURCES, modules, nodes
from tests.ui.fakes import figures_once
from tests.ui.hand_fakes import hand_session


@SOURCES
def test_no_change_is_never_claimed() -> None:
    assert verdict_word("no_change") == change_since_first("no_change", 2.0) == no_change_words() == "no change proven"
    assert difference(0.2) == "0°"
    said = []
    for path in modules("ui", "app", "core"):
        for node in nodes(path):
            if isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in ("tr",):
                said += [one.value for one in node.args if isinstance(one, ast.Constant)]
    claims = [words for words in said if isinstance(words, str) and "no change" in words.casefold()]
    assert claims
    assert all("no change proven" in words.casefold() for words in claims), claims


@pytest.mark.parametrize(("speed", "words"), [(2.0, "<\N{NO-BREAK SPACE}10°/s"), (38.0, "38°/s"), (math.nan, "–")])
def test_a_still_hand_has_no_speed(speed: float, words: str) -> None:
    assert speed_words(speed) == words


def test_the_list_s_figure_is_of_the_joint_that_is_trained_and_says_at_least() -> None:
    figures = figures_once(hand_session())
    trained = figure_of(figures.exercise.joint).finger
    rows = {figure.finger: figures.row("arc", -1, figure.joint) for figure in compared_figures(figures)}
    row = rows[trained]
    assert row is not None
    words = main_figure(figures)
    assert words.startswith(next(one.long_name for one in compared_figures(figures) if one.finger == trained))
    assert ("≥" in words) == row.limited
    assert exercise_named(figures.exercise.id).joint == figures.exercise.joint


def test_two_sessions_of_one_day_have_names_of_their_own() -> None:
    fist = session_report(hand_session())
    wrist = replace(fist, figures=replace(fist.figures, exercise=exercise_named("WRIST_FE")))
    later = replace(fist, figures=replace(fist.figures, when=fist.figures.when + timedelta(hours=1)))
    assert len({suggested_name(one) for one in (fist, wrist, later)}) == 3


def test_the_head_of_a_column_is_short_on_one_day_too() -> None:
    now = datetime(2026, 11, 20, 15, 29)
    assert numbers.since(now.replace(hour=9), now) == "09:29"
    assert numbers.since(now.replace(day=13), now) == "13 Nov"
