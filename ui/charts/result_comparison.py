"""Two result versions of one recording in one chart: the previous one grey and thin."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts.series import Curve, Series
from carpus.ui.charts.session import HandPlot, SessionPlot, Value
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr
from carpus.ui.words.finger_angles import find_finger_angle

# Dashes mean predicted samples, in both.
OLD_TOKEN, OLD_WIDTH_FACTOR = "text2", 0.45


def _to_old_style(curve: Curve) -> Curve:
    """Return the curve grey, thin and without band, which would hide the other one."""
    return replace(curve, series=replace(curve.series, sd=None), token=OLD_TOKEN, width_factor=OLD_WIDTH_FACTOR)


@dataclass(frozen=True, slots=True)
class ComparisonPlot(SessionPlot):
    """Wrist angles of a session, and its ``previous`` result."""

    old: WristCurves | None = None

    @property
    def _previous_plot(self) -> SessionPlot:
        assert self.old is not None
        return SessionPlot(self.old, self.exercise, self.repetitions, window_s=self.window_s)

    @property
    def has_readings(self) -> bool:
        return True

    def visible_curves(self, key: int, points: int) -> list[Curve]:
        old = [_to_old_style(one) for one in self._previous_plot.visible_curves(key, points)]
        return [*old, *super(ComparisonPlot, self).visible_curves(key, points)]

    def curve_series(self, key: int) -> list[tuple[str, Series]]:
        own = super(ComparisonPlot, self).curve_series(key)
        return [*own, *((f"{name}_old", series) for name, series in self._previous_plot.curve_series(key))]

    def read_values(self, key: int, time_s: float) -> list[Value]:
        (new,), (old,) = (
            super(ComparisonPlot, self).read_values(key, time_s),
            self._previous_plot.read_values(key, time_s),
        )
        was = _previous_value_text(old.value_deg)
        return [
            replace(new, text=_value_text(new)),
            replace(old, token=OLD_TOKEN, width_factor=OLD_WIDTH_FACTOR, text=was),
        ]


def _value_text(value: Value) -> str:
    if not math.isfinite(value.value_deg):
        return numbers.UNKNOWN
    return f"{numbers.format_signed_degrees(value.value_deg)} {numbers.format_sd(value.sd_deg)}"


@dataclass(frozen=True, slots=True)
class HandComparisonPlot(HandPlot):
    """Joints of one finger of a session, and their ``previous`` result."""

    old: JointCurves | None = None

    @property
    def _previous_plot(self) -> HandPlot:
        return HandPlot(
            self.curves, self.exercise, self.repetitions, window_s=self.window_s, joints=self.old, finger=self.finger
        )

    def visible_curves(self, key: int, points: int) -> list[Curve]:
        old = [_to_old_style(one) for one in self._previous_plot.visible_curves(key, points)]
        return [*old, *super(HandComparisonPlot, self).visible_curves(key, points)]

    def curve_series(self, key: int) -> list[tuple[str, Series]]:
        own = super(HandComparisonPlot, self).curve_series(key)
        return [*own, *((f"{name}_old", series) for name, series in self._previous_plot.curve_series(key))]


def legend_words() -> tuple[str, str]:
    """Return the legend of the old and of the new result."""
    return tr("old result"), tr("new result")


def find_changed_finger(previous: JointCurves | None, current: JointCurves | None) -> int:
    """Return the finger (1 to 5) whose joints differ most between two results, 0 if none does."""
    if (
        previous is None
        or current is None
        or previous.names != current.names
        or previous.angles_deg.shape != current.angles_deg.shape
    ):
        return 0
    off = np.abs(current.angles_deg - previous.angles_deg)
    size = np.where(np.isfinite(off), off, 0.0).max(axis=0, initial=0.0)
    if not len(size) or float(size.max()) < 1.0:
        return 0
    return find_finger_angle(current.names[int(size.argmax())]).finger


def _previous_value_text(angle_deg: float) -> str:
    return tr("was {angle}").format(angle=numbers.format_signed_degrees(angle_deg))
