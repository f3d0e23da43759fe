"""The papers' figures in the review and on the report: path, axes, velocities, ZYZ, finger joints, further figures."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path

import numpy as np
from PySide6.QtCore import QRectF

from carpus.core.results.motion_curves import compute_motion_curves
from carpus.ui.charts.motion import ACROSS, PathsChart, finger_paths
from carpus.ui.kit.theme import Theme
from carpus.ui.words.task_measures import task_summary, task_table
from tests.ui.conftest import Reviewing
from tests.ui.fakes import NOW, figures_once
from tests.ui.hand_fakes import FakeHandSessions, hand_session
from tests.ui.printed import read_words, write_session_report

BOX = QRectF(0.0, 0.0, 720.0, 300.0)


def test_thumb_side_is_on_its_side_of_panel_for_both_hands(theme: Theme) -> None:
    for side, thumb_left in (("right", True), ("left", False)):
        session = hand_session(exercise="FINGER_ABAD", motion="abduction", side=side)
        paths = finger_paths(compute_motion_curves(session))
        chart = PathsChart(theme, paths, side)
        chart.area = BOX
        chart.build()
        x = [float(np.nanmean(chart.plots[0].panel.x(path.position_mm[:, ACROSS[0]]))) for path in paths]
        assert (x[0] < x[4]) is thumb_left


def test_review_of_reaching_shows_outward_paths_beside_return_paths(review: Reviewing) -> None:
    store, made = FakeHandSessions(pictures=False), hand_session(exercise="REACH_GRASP", motion="reach_grasp")
    store.sessions = {"hand-7": made}
    screen = review(store, "hand-7")
    shown, figures = screen.card.tables.task_table, figures_once(made)
    names = {cell.text for row in shown.rows for cell in row}
    assert {"Movement time, outward", "Peak speed, return", "Maximum grip aperture, thumb–index"} <= names
    assert not any("SPARC" in name for name in names), "on the researcher's page"
    assert shown.isVisibleTo(screen)
    before = figures_once(hand_session(NOW - timedelta(days=7), 0.9, "REACH_GRASP", "hand-6", "reach_grasp"))
    rows = task_table(figures, before).rows
    assert [row[::3] for row in rows[:2]] == [
        ("Movement time, outward", "Movement time, return"), ("Peak speed, outward", "Peak speed, return"),
    ]  # fmt: skip
    assert all(all(row) for row in rows[:2])
    assert str(rows[0][1]).endswith("s")
    assert task_summary(figures).startswith("Reach 1.")
    touched = figures_once(hand_session(exercise="THUMB_OPP", motion="opposition"))
    assert task_summary(touched) == "The thumb touched 4 of 4 fingertips"
    assert task_summary(figures_once(hand_session())) == ""


def test_second_page_has_papers_values(tmp_path: Path) -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp")
    path = write_session_report(made, tmp_path / "reach.pdf")
    first, second = (read_words(path, page) for page in (1, 2))
    for words in (
        "page 2", "Path of the wrist", "Fingertip paths", "Position, speed, rotation", "ZYZ angles", "XY", "ZX",
        "ZY", "Movement time, outward", "mm/s", "Number of speed peaks, return", "Not a medical device",
    ):  # fmt: skip
        assert words in second, words
    assert "Reach 1." in first
    assert "TAM" not in first
