"""Position, velocities and ZYZ angles of the wrist over a session, as in the papers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from PySide6.QtCore import QRectF

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.core.results.motion_curves import MotionCurves
from carpus.ui.charts.axes import Panel, Scale
from carpus.ui.charts.chart import Plot
from carpus.ui.charts.paths import AXIS_LETTERS, AXIS_TOKENS
from carpus.ui.charts.series import Series, find_max_step_s
from carpus.ui.charts.session import SessionPlot, add_panel_name
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr

MotionKind = Literal["place", "zyz"]
# Possible ends of an axis: the smallest that holds the whole session, so that it does not change.
AXIS_LIMITS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0)
ZYZ_SUM = "α+γ"
ZYZ_NAMES = ("α", "β", "γ")
_UNITS = ("mm", "mm/s", "°/s")


def panel_words() -> tuple[str, str, str]:
    """Return the names of the position and velocity panels."""
    return tr("Position"), tr("Speed"), tr("Rotation")


@dataclass(frozen=True, slots=True)
class MotionPlot(SessionPlot):
    """Position, linear and angular velocity along three axes (``place``), or the ZYZ angles (``zyz``)."""

    motion: MotionCurves | None = None
    kind: MotionKind = "place"

    def quantity(self, key: int) -> FloatArray:
        """Return position, linear or angular velocity (N, 3)."""
        assert self.motion is not None
        return (self.motion.position_mm, self.motion.velocity_mm_s, self.motion.angular_velocity_deg_s)[key]

    def panel_order(self) -> list[int]:
        return [0, 1, 2]

    def panels(self, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
        """Return three panels of the same height, or with ``single`` the speed or beta alone."""
        keys = [1] if single else self.panel_order()
        height = (box.height() - between * (len(keys) - 1)) / len(keys)
        out = []
        for place, key in enumerate(keys):
            area = QRectF(box.left(), box.top() + place * (height + between), box.width(), height)
            out.append((Panel(area, self._scale(key), *self.visible_s), key))
        return out

    def _scale(self, key: int) -> Scale:
        if self.kind == "zyz":
            return _zyz_scale(key)
        known = np.abs(self.quantity(key))
        maximum = float(np.nanmax(known)) if np.isfinite(known).any() else 0.0
        top = next((step for step in AXIS_LIMITS if step >= maximum), AXIS_LIMITS[-1])
        unit = _UNITS[key]
        labels = (
            (top, f"+{_plain(top)}{_unit_suffix(unit)}"),
            (0.0, "0"),
            (-top, f"{MINUS}{_plain(top)}{_unit_suffix(unit)}"),
        )
        return Scale(-1.4 * top, 1.4 * top, (top, 0.0, -top), labels)

    def add_background(self, plot: Plot, place: int, key: int) -> None:
        plot.add_grid()
        add_panel_name(plot, self.panel_name(key))

    def panel_name(self, key: int) -> str:
        if self.kind == "zyz":
            return (*ZYZ_NAMES[:2], f"γ, {ZYZ_SUM}")[key]
        return panel_words()[key]

    def all_series(self, key: int) -> list[tuple[str, str, Series]]:
        assert self.motion is not None
        motion = self.motion
        step_s = find_max_step_s(motion.time_s)
        if self.kind == "zyz":
            sd = motion.zyz_sd_deg[:, key]
            own = Series(motion.time_s, motion.zyz_deg[:, key], sd, motion.is_predicted, step_s)
            shown = [(ZYZ_NAMES[key], ("deviation", "flexion", "deviation")[key], own)]
            if key == 2:  # what stays known where the two are not
                total = Series(motion.time_s, motion.zyz_sum_deg, None, motion.is_predicted, step_s)
                shown.append((ZYZ_SUM, "rotation", total))
            return shown
        values = self.quantity(key)
        return [
            (letter, token, Series(motion.time_s, values[:, axis], None, motion.is_predicted, step_s))
            for axis, (letter, token) in enumerate(zip(AXIS_LETTERS, AXIS_TOKENS, strict=True))
        ]

    def visible_curves(self, key: int, points: int) -> list:  # type: ignore[type-arg]
        return [one for _, token, series in self.all_series(key) for one in self._curves(series, token, points)]


MINUS = "\N{MINUS SIGN}"


def _plain(value: float) -> str:
    return format_rounded(value)


def _unit_suffix(unit: str) -> str:
    return unit if unit.startswith("°") else f"{numbers.NARROW_GAP}{unit}"


def _zyz_scale(key: int) -> Scale:
    if key == 1:
        return Scale(-20.0, 110.0, (90.0, 45.0, 0.0), ((90.0, "90°"), (0.0, "0°")), bold_ends=False)
    labels = ((180.0, "+180°"), (-180.0, f"{MINUS}180°"))
    return Scale(-250.0, 250.0, (180.0, 90.0, 0.0, -90.0, -180.0), labels, bold_ends=False)


def zyz_words(plots: Sequence[MotionCurves]) -> str:
    """Say for how much of the time the ZYZ angles are known."""
    known = [np.isfinite(curves.zyz_deg[:, 0]) for curves in plots]
    every = np.concatenate(known) if known else np.zeros(0, dtype=bool)
    share = f"{format_rounded(100.0 * float(every.mean()))}{numbers.NARROW_GAP}%" if len(every) else numbers.UNKNOWN
    return tr(
        "α and γ are shown only where their SD is below 30° ({share} of the time). Near the neutral position, only β "
        "and α + γ can be measured."
    ).format(share=share)
