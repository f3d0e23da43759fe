"""The one figure of a session that list and review name first, of the joints that the exercise trains."""

from __future__ import annotations

from carpus.core.results.figures import SessionFigures
from carpus.ui import terms
from carpus.ui.figures import figure_of
from carpus.ui.report.further_rows import short_words
from carpus.ui.report.hand_rows import compared_figures, range_words
from carpus.ui.report.tables import mean_words


def main_figure(figures: SessionFigures) -> str:
    """The figure that a therapist looks for first: the best of the trained movement, or the first joint."""
    about = short_words(figures)
    if about:
        return about
    if figures.joint_rows:
        trained = figure_of(figures.exercise.joint).finger
        for figure in sorted(compared_figures(figures), key=lambda one: one.finger != trained):
            row = figures.row("arc", -1, figure.joint)
            if row is not None and row.count:
                return f"{figure.long_name} {range_words(row)}"
        return ""
    rows = [row for row in figures.rows if row.movement != "arc" and row.count] or [*figures.rows]
    return f"{terms.movement_name(rows[0].movement)} {mean_words(rows[0])}" if rows else ""
