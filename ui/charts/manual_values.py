"""Manual measurements over time: hollow squares beside the dots of Carpus's own measurements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from datetime import date, datetime, time

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QSizePolicy

from carpus.core.measures.manual_measurements import ManualMeasure, ManualValue
from carpus.ui.charts.chart import Chart, Plot, date_labels
from carpus.ui.charts.panel import Panel, Scale
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.theme import Theme
from carpus.ui.words.manual_values import measure_name, value_words

DAY_S = 86_400.0


def day_timestamp(day: date, sessions: Iterable[datetime] = ()) -> float:
    """Return where a day lies on a time axis: at that day's session if there is one, else at noon."""
    same = [when for when in sessions if when.date() == day]
    return (same[0] if same else datetime.combine(day, time(12))).timestamp()


def add_manual_values(
    plot: Plot, values: Sequence[ManualValue], sessions: Sequence[datetime] = (), *, is_joined: bool = False
) -> None:
    """Add manual values of one measure and mode to a plot: squares, or diamonds for passive ones.

    ``sessions`` are the times of the recorded sessions. ``is_joined`` joins the values by a thin line, where nothing
    else is in the panel. A value beyond the time axis is an arrow at its end.
    """
    panel, chart = plot.visible_panel, plot.chart
    times = [day_timestamp(one.day, sessions) for one in values]
    places = [panel.point(at, one.value) for at, one in zip(times, values, strict=True)]
    if is_joined:
        plot.add_line(times, [one.value for one in values], "text", 1.6)
    pen = pg.mkPen(plot.plot_style.color("text"), width=1.6 * plot.plot_style.unit)
    symbol, size = ("d", 12.0) if values and values[0].mode == "passive" else ("s", 9.0)
    shown = [at for time, at in zip(times, places, strict=True) if panel.start_s <= time <= panel.end_s]
    chart.add_symbols(symbol, size, pen, "surface", shown)
    left, right = panel.box.left(), panel.box.right()
    if before := [at for at in places if at.x() < left - 1]:
        chart.add_symbols("t3", 10.0, pen, "surface", [QPointF(left, max(before, key=QPointF.x).y())])
    if after := [at for at in places if at.x() > right + 1]:
        chart.add_symbols("t2", 10.0, pen, "surface", [QPointF(right, min(after, key=QPointF.x).y())])


def manual_value_scale(measure: ManualMeasure, values: Sequence[float]) -> Scale:
    """Return a scale from zero, or the lowest value, to the next round number above all values."""
    top = max([*values, 0.5 * measure.usual_range[1] if measure.kind == "score" else 0.0, 1e-6])
    steps = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0, 500.0)
    bottom = min([*values, 0.0])
    step = next((one for one in steps if (top - bottom) / one <= 4.0), 500.0)
    low = step * math.floor(bottom / step)
    high = step * math.ceil(top / step + 1e-9)
    ticks = tuple(np.arange(low, high + step / 2, step).tolist())
    return Scale(low, high, ticks, tuple((tick, value_words(measure, tick)) for tick in ticks), bold_ends=False)


class ManualValueChart(Chart):
    """Chart of one manual measure; empty until :meth:`show_values`."""

    default_px, min_px = (400, 250), (260, 250)
    is_card = False

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.measure: ManualMeasure | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def sizeHint(self) -> QSize:
        return QSize(self.default_px[0], self._theme.px(self.default_px[1]))

    def minimumSizeHint(self) -> QSize:
        return QSize(self.min_px[0], self.sizeHint().height())

    def show_values(
        self, measure: ManualMeasure, values: Sequence[ManualValue], carpus_values: Sequence[tuple[datetime, float]]
    ) -> None:
        """Show manual values of all modes, and ``carpus_values`` (time, value) of the same quantity."""
        self.measure, self._values, self._carpus_values = measure, values, carpus_values
        self.setAccessibleName(self.tr("{name} over time").format(name=measure_name(measure)))
        self.refresh()

    def build(self) -> None:
        measure = self.measure
        if measure is None:
            return
        values, ours, look, box = self._values, self._carpus_values, self.plot_style, self.area
        unit, metrics = look.unit, QFontMetricsF(look.end_label_font)
        face = font(look.end_label_font.pixelSize() * 1.25, SEMIBOLD, display=False)
        title = QFontMetricsF(face).height()
        self.add_text(measure_name(measure), face).setPos(box.left(), box.top())
        passive = [one for one in values if one.mode == "passive"]
        active = [one for one in values if one.mode != "passive"]
        when = [one for one, _ in ours]
        times = [day_timestamp(one.day, when) for one in values] + [one.timestamp() for one in when]
        if not times:
            words = self.add_text(self.tr("No manual measurements yet."), look.end_label_font, "text2")
            words.setPos(box.left(), box.top() + 1.4 * title)
            return
        key = [("s", self.tr("manual, active") if len(measure.modes) > 1 else self.tr("manual"), "text")]
        key += [("d", self.tr("manual, passive"), "text")] if passive else []
        key += [("O", self.tr("Carpus, mean"), "flexion")] if ours else []
        pad = max(0.06 * (max(times) - min(times)), 2 * DAY_S)
        scale = manual_value_scale(measure, [one.value for one in values] + [value for _, value in ours])
        left = max(metrics.horizontalAdvance(text) for _, text in scale.labels) + 14 * unit
        right = metrics.horizontalAdvance(self.tr("passive {value}").format(value="100°")) + 20 * unit
        area = QRectF(
            box.left() + left, box.top() + title + 12 * unit, box.width() - left - right,
            box.height() - title - (1 + len(self.legend_lines(key, box.width()))) * metrics.height() - 34 * unit,
        )  # fmt: skip
        plot = self.add_plot(Panel(area, scale, min(times) - pad, max(times) + pad))
        plot.add_grid()
        beside = []
        if ours:
            plot.add_line([one.timestamp() for one in when], [value for _, value in ours], "flexion")
            at = [plot.panel.point(one.timestamp(), value) for one, value in ours]
            self.add_symbols("o", 8.0, pg.mkPen(look.color("flexion"), width=look.line_width), "flexion", at)
            sentence = self.tr("Carpus {value}").format(value=value_words(measure, ours[-1][1]))
            beside.append((ours[-1][1], sentence, "flexion"))
        for some in (passive, active):
            add_manual_values(plot, some, sessions=when, is_joined=not ours)
            if some:
                pattern = {"passive": self.tr("passive {value}"), "active": self.tr("active {value}")}.get(
                    some[-1].mode, "{value}"
                )
                sentence = pattern.format(value=value_words(measure, some[-1].value))
                beside.append((some[-1].value, sentence, "text"))
        self.add_end_labels(plot, beside)
        days = sorted({one.day for one in values} | {one.date() for one in when})
        self.add_axis(
            plot, "bottom", date_labels([(day_timestamp(day), numbers.format_day_month(day)) for day in days]), 6
        )
        self.add_legend(key, box)
