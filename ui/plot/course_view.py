"""The card with the chart of the sessions: a point says what it is, and opens its session."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter

from carpus.core.results.measure import MeasureKey
from carpus.core.results.progress import Progress
from carpus.core.rounding import written
from carpus.ui import numbers, terms
from carpus.ui.plot import axes, course
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.marks import MouseReadout
from carpus.ui.plot.style import PlotStyle, screen_style
from carpus.ui.plot.zoom_card import ZoomCard
from carpus.ui.theme import Theme
from carpus.ui.words.progress import corrected_words, doubt_words, unfair_words

if TYPE_CHECKING:
    from carpus.ui.plot.canvas import Canvas, Layer

NEAR_PX = 16
"""Half the width of the target around a point: 32 px."""
DAY_S = 86_400.0
LONGEST_LINE = 60
"""Letters of a line of what a point says."""


class ProgressChart(ZoomCard):
    """``opened`` carries the session of a point that was clicked, or chosen by key."""

    usual_px, least_px = (864, 560), (480, 320)
    shortest = DAY_S

    opened = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "progress")
        self._progress = Progress((), (), None)
        self._mouse: QPointF | None = None
        self._pointed: tuple[int, MeasureKey] | None = None
        """Number of the session and panel of the point under the mouse, or chosen by key."""
        self.setAccessibleName(self.tr("Range over the sessions"))

    def show_progress(self, progress: Progress) -> None:
        self._progress = progress
        self._window = None
        self._pointed = None
        self.forget()

    @property
    def pointed(self) -> int:
        """Number of the session that is pointed at, -1 for none."""
        return -1 if self._pointed is None else self._pointed[0]

    def step(self, by: int) -> None:
        found = [at for at in self.points() if at[1] == next(iter(course.panels_of(self._progress)), None)]
        if not found:
            return
        numbers_of = [number for number, _, _ in found]
        now = numbers_of.index(self.pointed) if self.pointed in numbers_of else -1 if by > 0 else len(numbers_of)
        number, key, _ = found[min(max(now + by, 0), len(found) - 1)]
        self._point_at((number, key))

    def open_pointed(self) -> None:
        if self._pointed is not None:
            self.opened.emit(self._progress.points[self._pointed[0]].figures.session_id)

    # --- window -------------------------------------------------------------------------------------------
    def extent(self) -> tuple[float, float] | None:
        return course.extent_s(self._progress) if course.panels_of(self._progress) else None

    def about(self) -> float:
        if self._pointed is not None:
            return self._progress.points[self._pointed[0]].figures.when.timestamp()
        return super().about()

    # --- places -------------------------------------------------------------------------------------------
    def _box(self) -> QRectF:
        return QRectF(self.rect()).adjusted(20.5, 16.5, -16.5, -14.5)

    def panels(self) -> list[tuple[Panel, MeasureKey]]:
        placed = course.place_panels(self._progress, screen_style(self._theme), self._box(), self._window)
        return [(replace(panel, box=axes.crisp(panel.box)), key) for panel, key in placed]

    def points(self) -> list[tuple[int, MeasureKey, QPointF]]:
        return [
            (number, key, at)
            for panel, key in self.panels()
            for number, at in course.Points(self._progress, key).places(panel)
            if panel.box.left() - 1 <= at.x() <= panel.box.right() + 1
        ]

    def point_at(self, at: QPointF) -> tuple[int, MeasureKey] | None:
        near = [(math.hypot(p.x() - at.x(), p.y() - at.y()), number, key) for number, key, p in self.points()]
        away, number, key = min(near, default=(math.inf, 0, ("", "arc")))
        return (number, key) if away <= NEAR_PX else None

    # --- what is in it ------------------------------------------------------------------------------------
    def furnish(self, canvas: Canvas) -> None:
        super().furnish(canvas)
        self._said: Layer = canvas.add_layer(self._paint_said)

    def lay_out(self, canvas: Canvas) -> None:
        self.more.setVisible(self.extent() is not None)
        canvas.lay_out([panel for panel, _ in self.panels()], self.extent(), self.shortest)
        self._said.cover(QRectF(self.rect()))
        self._said.update()

    def show_marks(self, canvas: Canvas) -> None:
        canvas.show_marks([[course.Points(self._progress, key, self.pointed)] for _, key in self.panels()])

    def paint_ground(self, painter: QPainter) -> None:
        course.paint_behind(painter, screen_style(self._theme), self._box(), self._progress, self.panels())

    # --- a point ------------------------------------------------------------------------------------------
    def said_of(self, number: int, key: MeasureKey) -> list[str]:
        point = self._progress.points[number]
        figures, row = point.figures, course.row_of(self._progress, number, key)
        assert row is not None
        least = f"≥{numbers.NARROW_GAP}" if row.angle < 0 and row.at_least else ""
        value = f"{least}{numbers.with_spread(row.mean, row.sd)}"
        if row.angle >= 0:
            value = terms.end_words(row.mean, row.what, row.sd)
        named = self.tr("{name} {value}, {count} repetitions")
        lines = [
            numbers.report_date(figures.when),
            named.format(name=course.name_of(self._progress, key), value=value, count=row.count),
        ]
        quality = figures.quality
        if math.isfinite(quality.distance_m):
            lines.append(self.tr("Camera {distance} cm away").format(distance=written(100 * quality.distance_m)))
        if not point.fair:
            lines.append(unfair_words(point, self._progress))
        elif said := doubt_words(point, self._progress):
            lines.append(said)
        if said := corrected_words(figures):
            lines.append(said)
        lines += [f"“{text}”" for _, text in figures.notes[:1]]
        lines.append(self.tr("Click opens the session"))
        return [line if len(line) <= LONGEST_LINE else f"{line[: LONGEST_LINE - 1].rstrip()}…" for line in lines]

    def _paint_said(self, painter: QPainter) -> None:
        if self._pointed is None:
            return
        number, key = self._pointed
        at = next((at for other, own, at in self.points() if (other, own) == (number, key)), None)
        if at is not None:
            room = QRectF(self.rect()).adjusted(4, 4, -4, -4)
            MouseReadout(self.said_of(number, key), at, room).paint(painter, screen_style(self._theme))

    def _point_at(self, found: tuple[int, MeasureKey] | None) -> None:
        if found != self._pointed:
            self._pointed = found
            self.draw()
            if self._canvas is not None:
                self._said.update()

    # --- mouse --------------------------------------------------------------------------------------------
    def hover(self, at: QPointF | None) -> None:
        found = None if at is None else self.point_at(at)
        self._point_at(found)
        inside = at is not None and any(panel.box.contains(at) for panel, _ in self.panels())
        pans = Qt.CursorShape.OpenHandCursor if inside and self._window is not None else Qt.CursorShape.ArrowCursor
        self.face.setCursor(pans if found is None else Qt.CursorShape.PointingHandCursor)

    def click(self, event: Any) -> None:
        if event.double():
            self.show_all()
            return
        found = self.point_at(event.scenePos())
        self._point_at(found)
        if found is not None:
            self.open_pointed()

    # --- for other programs -------------------------------------------------------------------------------
    def paint_on(self, painter: QPainter, style: PlotStyle, box: QRectF) -> None:
        course.paint_chart(painter, style, box, self._progress)

    def table(self) -> tuple[Sequence[str], Iterable[Sequence[str]]]:
        """One row for each session and panel that is shown."""
        head = ["session", "when", "what", "mean_deg", "sd_deg", "repetitions", "compared"]
        start, end = self.shown()
        rows = []
        for key in course.panels_of(self._progress):
            for number, point in enumerate(self._progress.points):
                row = course.row_of(self._progress, number, key)
                if row is None or not start <= point.figures.when.timestamp() <= end:
                    continue
                sd = written(row.sd, 1) if math.isfinite(row.sd) else ""
                what = row.of if row.angle < 0 else row.what
                when = point.figures.when.isoformat(timespec="seconds")
                compared = "yes" if point.fair else "no"
                rows.append([point.figures.session_id, when, what, written(row.mean, 1), sd, str(row.count), compared])
        return head, rows
