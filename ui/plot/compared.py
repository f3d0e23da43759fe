"""Two results of one recording over each other: the old one grey and thin, the new one as always."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.ui import numbers
from carpus.ui.figures import figure_of
from carpus.ui.plot.series import Curve, Series
from carpus.ui.plot.session import HandPlot, SessionPlot, Value
from carpus.ui.translate import tr

OLD_TOKEN, OLD_SHARE = "text2", 0.45
"""Dashes are of what was predicted, of either."""


def _old(curve: Curve) -> Curve:
    """Without its band: two over each other would hide what they say."""
    return replace(curve, series=replace(curve.series, sd=None), token=OLD_TOKEN, share=OLD_SHARE)


@dataclass(frozen=True, slots=True)
class ComparedPlot(SessionPlot):
    """The wrist's angles as a session has them, and ``old`` as it had them before."""

    old: ReportCurves | None = None

    @property
    def _before(self) -> SessionPlot:
        assert self.old is not None
        return SessionPlot(self.old, self.exercise, self.repetitions, window_s=self.window_s)

    @property
    def has_readings(self) -> bool:
        return True

    def moving(self, key: int, points: int) -> list[Curve]:
        old = [_old(one) for one in self._before.moving(key, points)]
        return [*old, *super(ComparedPlot, self).moving(key, points)]

    def columns(self, key: int) -> list[tuple[str, Series]]:
        own = super(ComparedPlot, self).columns(key)
        return [*own, *((f"{name}_old", series) for name, series in self._before.columns(key))]

    def values(self, key: int, time_s: float) -> list[Value]:
        (new,), (old,) = super(ComparedPlot, self).values(key, time_s), self._before.values(key, time_s)
        was = _was(old.value_deg)
        return [replace(new, said=_signed(new)), replace(old, token=OLD_TOKEN, share=OLD_SHARE, said=was)]


def _signed(value: Value) -> str:
    """The panel's scale says which side is which."""
    if not math.isfinite(value.value_deg):
        return numbers.UNKNOWN
    return f"{numbers.signed_degrees(value.value_deg)} {numbers.spread(value.sd_deg)}"


@dataclass(frozen=True, slots=True)
class ComparedHandPlot(HandPlot):
    """The joints of one finger as a session has them, and ``old`` as it had them before."""

    old: JointCurves | None = None

    @property
    def _before(self) -> HandPlot:
        return HandPlot(
            self.curves, self.exercise, self.repetitions, window_s=self.window_s, joints=self.old, finger=self.finger
        )

    def moving(self, key: int, points: int) -> list[Curve]:
        old = [_old(one) for one in self._before.moving(key, points)]
        return [*old, *super(ComparedHandPlot, self).moving(key, points)]

    def columns(self, key: int) -> list[tuple[str, Series]]:
        own = super(ComparedHandPlot, self).columns(key)
        return [*own, *((f"{name}_old", series) for name, series in self._before.columns(key))]


def legend_words() -> tuple[str, str]:
    """Of the old and of the new result."""
    return tr("old result"), tr("new result")


def most_different_finger(old: JointCurves | None, new: JointCurves | None) -> int:
    """The finger, 1 to 5, one of whose joints differs most between two results; 0 where none does."""
    if old is None or new is None or old.names != new.names or old.angles_deg.shape != new.angles_deg.shape:
        return 0
    off = np.abs(new.angles_deg - old.angles_deg)
    size = np.where(np.isfinite(off), off, 0.0).max(axis=0, initial=0.0)
    if not len(size) or float(size.max()) < 1.0:
        return 0
    return figure_of(new.names[int(size.argmax())]).finger


def _was(angle_deg: float) -> str:
    return tr("was {angle}").format(angle=numbers.signed_degrees(angle_deg))
