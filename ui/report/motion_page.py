"""Second page of the session report: task measures and the papers' figures, with the charts of these."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QVBoxLayout

from carpus.core.results.motion_curves import MotionCurves
from carpus.core.results.session_results import SessionResults
from carpus.core.results.valid_data import WristCurves
from carpus.ui.charts.motion import MotionKind, MotionPlot, PathsChart, finger_paths, wrist_path, zyz_words
from carpus.ui.charts.session import SessionChart
from carpus.ui.kit import numbers
from carpus.ui.kit.layouts import STRETCH, Part
from carpus.ui.kit.translate import tr
from carpus.ui.report.page import (
    chart_part,
    column,
    legal_line,
    paragraph,
    section_title,
    table,
)
from carpus.ui.words.session import research_lines
from carpus.ui.words.task_measures import task_table, task_title


def motion_page(
    results: SessionResults, previous: SessionResults | None, curves: WristCurves, motion: MotionCurves, origin: str
) -> QVBoxLayout:
    """Return the page under its head; ``origin`` are the digests of what it was made from."""
    is_hand = bool(motion.joint_names)
    parts: list[Part] = _task_measure_section(results, previous)
    if lines := research_lines(results):
        words = ";  ".join(f"{name}: {value}" for name, value in lines)
        parts.append(paragraph(words, 8.5))
    height = 118.0 if is_hand else 165.0
    chart = partial(PathsChart, paths=wrist_path(motion), side=motion.side, axes=motion.axes)
    parts.append(section_title(tr("Path of the wrist"), tr("with the axes of the hand along the path")))
    parts.append(chart_part(chart, height, 1.2 * height))
    if is_hand:
        chart = partial(PathsChart, paths=finger_paths(motion), side=motion.side)
        parts.append(section_title(tr("Fingertip paths"), tr("joint centres; dashed: marker occluded")))
        parts.append(chart_part(chart, height, 1.2 * height))
    axes = tr("X (black) to the fingers, Y (blue) to the thumb, Z (orange) up")
    if motion.side == "left":
        axes = tr("X (black) to the fingers, Y (blue) away from the thumb, Z (orange) up")

    def curves_part(kind: MotionKind, heading: str, aside: str, share: float) -> list[Part]:
        plot = MotionPlot(curves, results.exercise, results.repetitions, -1, motion=motion, kind=kind)
        least = share * (150.0 if is_hand else 205.0)
        return [section_title(heading, aside), chart_part(partial(SessionChart, plot=plot), least, 1.2 * least)]

    parts += curves_part("place", tr("Position, speed, rotation"), axes, 1.0)
    parts += curves_part("zyz", tr("ZYZ angles"), tr("band: ± 1 SD; black: α + γ"), 0.75)
    below = [paragraph(words, 8.0, token="text2") for words in (zyz_words(motion), origin) if words]
    foot = column(*below, legal_line(), gap=3.0)
    return column(*parts, STRETCH, foot, gap=6.0)


def _task_measure_section(results: SessionResults, previous: SessionResults | None) -> list[Part]:
    columns, _, rows = task_table(results, previous)
    if not rows:
        return []
    day = (
        numbers.format_distinct_day(previous.when, results.when)
        if previous is not None and previous.measures_in_group("task")
        else ""
    )
    shown = table(columns, (), rows, size=8.5, pitch=1.5)
    aside = tr("mean ± SD; right column: {day}").format(day=day) if day else ""
    return [column(section_title(task_title(results), aside), shown, gap=2.0)]
