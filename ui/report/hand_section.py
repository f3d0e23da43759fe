"""Whole-hand sections of the session report: finger table, wrist and curves."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from carpus.core.results.session_results import SessionResults
from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts.session import FLEXION_KINDS, HandPlot
from carpus.ui.kit.card import ColorFill
from carpus.ui.kit.cells import cell_text
from carpus.ui.kit.layouts import Part
from carpus.ui.kit.text import REGULAR, SEMIBOLD
from carpus.ui.kit.translate import tr
from carpus.ui.report.page import (
    PAPER,
    column,
    label,
    line,
    paragraph,
    rule,
    section_title,
    session_chart_part,
    table,
    to_layout_units,
)
from carpus.ui.words.finger_angles import KIND_TOKENS, kind_name
from carpus.ui.words.fingers import finger_table, limitation_words
from carpus.ui.words.ranges import mean_words, repetition_words
from carpus.ui.words.terms import arc_name


def finger_section(
    results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None
) -> list[Part]:
    """Return the table of the fingers and what occlusion limited."""
    columns, heads, rows = finger_table(results, previous, other_hand)
    shown = table(columns, [cell_text(head) for head in heads], rows, pitch=2.0)
    words = limitation_words(results)
    below = [paragraph(words, 8.0)] if words else []
    return [
        column(section_title(tr("Range of motion of the fingers"), repetition_words(results)), shown, *below, gap=2.0)
    ]


def wrist_section(results: SessionResults) -> list[Part]:
    """Return the wrist's three arcs in one line."""
    arcs = [
        (
            line(
                paragraph(arc_name(row.wrist_angle), 8.5, REGULAR, "text2"),
                6.0,
                (paragraph(mean_words(row), 9.0, SEMIBOLD), 1),
            ),
            1,
        )
        for row in results.wrist_ranges
        if row.quantity == "arc"
    ]
    shown = line(*arcs) if arcs else paragraph(tr("not visible"), 8.5, REGULAR, "text2")
    return [column(section_title(tr("Wrist"), tr("total arcs over the same period")), shown, rule(), gap=2.0)]


def finger_curve_section(curves: WristCurves, joints: JointCurves, results: SessionResults) -> list[Part]:
    """Return the flexion curves of every finger."""
    key: list[QWidget | float] = []
    for row in FLEXION_KINDS:
        swatch = ColorFill(PAPER, KIND_TOKENS[row])
        swatch.setFixedSize(*to_layout_units(10.0, 1.6))
        name = tr("PIP (thumb: palmar abduction)") if row == "middle" else kind_name(row)
        key += [swatch, 4.0, label(name, 8.5, REGULAR, "text2"), 8.0]
    key.append(label(tr("dashed: occluded; hatched: lost"), 8.5, REGULAR, "text2"))
    plot = HandPlot(curves, results.exercise, results.repetitions, -1, joints=joints)
    return [section_title(tr("Finger flexion over time"), *key), session_chart_part(plot, 140.0, 220.0)]
