"""The part of the session report that is the whole hand's: table of the fingers, the wrist beside it, curves."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from carpus.core.results.figures import SessionFigures
from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.ui.controls.card import Fill
from carpus.ui.controls.layouts import Part
from carpus.ui.controls.text import REGULAR, SEMIBOLD
from carpus.ui.figures import TOKENS, row_name
from carpus.ui.plot.session import BENDING, HandPlot
from carpus.ui.report.page import PAPER, column, label, line, paragraph, points, rule, session_curves, table, title
from carpus.ui.terms import arc_name
from carpus.ui.translate import tr
from carpus.ui.words.fingers import finger_table, limits_words
from carpus.ui.words.ranges import mean_words, repetition_words
from carpus.ui.words.table import cell_words


def finger_part(figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None) -> list[Part]:
    """One row for each finger, then in words what the camera's view limits."""
    columns, heads, rows = finger_table(figures, previous, other)
    shown = table(columns, [cell_words(head) for head in heads], rows, pitch=2.0)
    words = limits_words(figures)
    below = [paragraph(words, 8.0)] if words else []
    return [column(title(tr("Range of motion of the fingers"), repetition_words(figures)), shown, *below, gap=2.0)]


def wrist_line(figures: SessionFigures) -> list[Part]:
    """The wrist's three arcs in one line under the table of the fingers."""
    arcs = [
        (
            line(
                paragraph(arc_name(row.angle), 8.5, REGULAR, "text2"),
                6.0,
                (paragraph(mean_words(row), 9.0, SEMIBOLD), 1),
            ),
            1,
        )
        for row in figures.wrist_ranges
        if row.what == "arc"
    ]
    shown = line(*arcs) if arcs else paragraph(tr("not seen"), 8.5, REGULAR, "text2")
    return [column(title(tr("Wrist"), tr("whole arcs over the same time")), shown, rule(), gap=2.0)]


def finger_curves(curves: ReportCurves, joints: JointCurves, figures: SessionFigures) -> list[Part]:
    """Bending of every finger over time, in the height that is left; dashed where it was hidden."""
    key: list[QWidget | float] = []
    for row in BENDING:
        swatch = Fill(PAPER, TOKENS[row])
        swatch.setFixedSize(*points(10.0, 1.6))
        name = tr("Middle joint, of the thumb lift") if row == "middle" else row_name(row)
        key += [swatch, 4.0, label(name, 8.5, REGULAR, "text2"), 8.0]
    key.append(label(tr("dashed: hidden; hatched: lost"), 8.5, REGULAR, "text2"))
    plot = HandPlot(curves, figures.exercise, figures.repetitions, -1, joints=joints)
    return [title(tr("Bending over time"), *key), session_curves(plot, 140.0, 220.0)]
