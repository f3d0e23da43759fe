"""The curves of a whole session with its repetitions, wrist or fingers: what is drawn on the screen and on the page."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from carpus.core.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.hand.forearm_rotation import axis_deg, is_from_thumb_up
from carpus.core.hand.kinematics import DIP_PER_PIP
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.core.rounding import written
from carpus.core.types import FloatArray, TrackStatus
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure, Row, spread_labels
from carpus.ui.marker_words import finger_name
from carpus.ui.plot import axes
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.marks import Curves, Mark, Name, Remark, RepetitionMarks, Scales, StayWithin, Target, Times
from carpus.ui.plot.series import Curve, Series, longest_step_s
from carpus.ui.plot.style import PlotStyle
from carpus.ui.theme import CURVE_TOKENS
from carpus.ui.translate import tr

BESIDE_S = 1.0
"""Shown before the first and after the last repetition where the rest is left away."""
EDGES_S = 0.2
"""Least length a repetition can be cut to."""
FEWEST_POINTS = 200
BENDING: tuple[Row, ...] = ("knuckle", "middle", "end")
_BEND_LOW_DEG, _BEND_HIGH_DEG, _SPREAD_DEG = -15.0, 115.0, 32.0


def target_marks(positive_deg: float, negative_deg: float) -> list[Mark]:
    """The lines of the targets that there are, in degrees their own way: ``Target −40°`` of a supination short of thumb
    up. Their words stand on the far side, where no curve comes from."""
    words = tr("Target {angle}")
    targets = [(value, way) for value, way in ((positive_deg, 1), (negative_deg, -1)) if math.isfinite(value)]
    return [
        Target(value, words.format(angle=numbers.signed_degrees(way * value)), is_below=way < 0)
        for value, way in targets
    ]


def no_value_words() -> str:
    """What stands where nothing is known."""
    return tr("no value")


def group_words() -> tuple[str, str]:
    """The two kinds of angles of one finger."""
    return tr("Bending"), tr("Spreading")


def stay_words(limit_deg: float, key: int) -> str:
    """What is said of an angle that should hardly move."""
    within = tr("should stay within {angle}").format(angle=numbers.degrees(limit_deg))
    return within if key != PRONOSUPINATION else tr("rotation from the start; {within}").format(within=within)


def zero_marks(key: int, exercise: Exercise) -> list[Mark]:
    """Where the forearm's rotation is counted from, at its zero; nothing of the other angles."""
    if key != PRONOSUPINATION:
        return []
    return [Remark(0.0, tr("0° = thumb up") if is_from_thumb_up(exercise) else tr("rotation from the start"))]


@dataclass(frozen=True, slots=True)
class Value:
    """What is known of one curve at a time: degrees, and whether it was hidden; NaN in a gap."""

    name: str
    token: str
    value_deg: float
    sd_deg: float
    hidden: bool = False
    said: str = ""
    """What is written of it where that is no angle with its sd."""
    share: float = 1.0
    """Of the usual width, as its curve."""

    @property
    def words(self) -> str:
        """``42° ± 2°``."""
        return self.said or numbers.with_spread(self.value_deg, self.sd_deg)


@dataclass(frozen=True, slots=True)
class SessionPlot:
    """The wrist's three angles, with exercise, repetitions, and the current one (-1 for none)."""

    curves: ReportCurves
    exercise: Exercise
    repetitions: Sequence[ShownRepetition]
    current: int = -1
    target_positive_deg: float = math.nan
    target_negative_deg: float = math.nan
    window_s: tuple[float, float] | None = None
    """The part of the time axis that is shown; None for all of it."""

    @property
    def has_readings(self) -> bool:
        """Whether several numbers stand beside a panel, one under the other, instead of a name and its value."""
        return False

    def unit(self, key: int) -> str:
        """Unit of a panel's curves as columns of a file are called."""
        return "deg"

    @property
    def shown_s(self) -> tuple[float, float]:
        return self.window_s or (0.0, self.end_s)

    @property
    def repetitions_s(self) -> tuple[float, float]:
        """From shortly before the first repetition to shortly after the last; the whole where there is none."""
        if not self.repetitions:
            return 0.0, self.end_s
        start_s, end_s = self.repetitions[0].start_s, max(repetition.end_s for repetition in self.repetitions)
        return max(start_s - BESIDE_S, 0.0), min(end_s + BESIDE_S, self.end_s)

    @property
    def end_s(self) -> float:
        return max(float(self.curves.time_s[-1]), 1.0) if len(self.curves.time_s) else 1.0

    def order(self) -> list[int]:
        first = FLEXION if self.exercise.angle is None else self.exercise.angle
        return [first, *[k for k in (FLEXION, 0, PRONOSUPINATION) if k != first]]

    def series(self, column: int) -> Series:
        curves = self.curves
        return Series(
            curves.time_s,
            curves.angles_deg[:, column],
            curves.sds_deg[:, column],
            curves.status == TrackStatus.PREDICTED,
            longest_step_s(curves.time_s),
        )

    # --- what is drawn ------------------------------------------------------------------------------------
    def panels(self, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
        """Three panels in a box with the column each shows, the trained angle twice as high; or that one alone."""
        order = self.order()[: 1 if single else 3]
        unit = (box.height() - between * (len(order) - 1)) / (len(order) + 1)
        top, out = box.top(), []
        for place, column in enumerate(order):
            height = unit * (2 if place == 0 else 1)
            names = terms.direction_names(column, self.exercise)
            scale = axes.angle_scale(*axis_deg(column, self.exercise), *names, tight=place > 0)
            out.append((Panel(QRectF(box.left(), top, box.width(), height), scale, *self.shown_s), column))
            top += height + between
        return out

    def still(self, place: int, key: int) -> list[Mark]:
        """What lies behind the curves of the panel at a place from the top."""
        out: list[Mark] = []
        limit = self.exercise.trick_limit_deg
        if place > 0 and math.isfinite(limit):
            out.append(StayWithin(limit, stay_words(limit, key)))
        else:
            out += zero_marks(key, self.exercise)
        out.append(Scales())
        if place == 0:
            out += target_marks(self.target_positive_deg, self.target_negative_deg)
        return out

    def moving(self, key: int, points: int) -> list[Curve]:
        """The curves of a panel over what is shown, of about so many points each."""
        return [self._curve(self.series(key), CURVE_TOKENS[key], points)]

    def _curve(self, series: Series, token: str, points: int) -> Curve:
        return Curve(thinned(within(series, *self.shown_s), max(FEWEST_POINTS, points)), token)

    def columns(self, key: int) -> list[tuple[str, Series]]:
        """Name and whole series of every curve of a panel, for reading off and for tables."""
        name = WRIST_ANGLES[key]
        if key == PRONOSUPINATION:  # as it is read: the files' name has the files' zero
            name = "supination_from_thumb_up" if is_from_thumb_up(self.exercise) else "rotation_from_start"
        return [(name, self.series(key))]

    def values(self, key: int, time_s: float) -> list[Value]:
        value, sd = value_at(self.curves, key, time_s)
        name = terms.direction_name(key, value, self.exercise) if math.isfinite(value) else no_value_words()
        return [Value(name, CURVE_TOKENS[key], value, sd)]


@dataclass(frozen=True, slots=True)
class HandPlot(SessionPlot):
    """As a session of the wrist, with the joints; ``finger`` 1 to 5, or 0 for all of them."""

    joints: JointCurves | None = None
    finger: int = 0
    _drawn: dict[Figure, tuple[JointCurves, Series | None]] = field(default_factory=dict, repr=False, compare=False)
    """What :meth:`joint_series` has found: it is asked at every step of the wheel."""

    def figures(self, panel: int) -> list[Figure]:
        if self.finger and panel == 1:
            return [Figure(self.finger, "spread")]
        return [Figure(self.finger or FINGERS[panel], row) for row in BENDING]

    def joint_series(self, figure: Figure) -> Series | None:
        """A joint as it is drawn, dashed where it was not seen; None for one that is neither measured nor bound."""
        joints = self.joints
        assert joints is not None
        of, found = self._drawn.get(figure, (None, None))
        if of is not joints:
            found = _joint_series(joints, figure)
            self._drawn[figure] = joints, found
        return found

    def is_bound(self, figure: Figure) -> bool:
        return self.joints is not None and figure.joint not in self.joints.names

    def panels(self, box: QRectF, between: float, *, single: bool = False) -> list[tuple[Panel, int]]:
        """One panel for each finger, or bending over spreading; ``single`` leaves the spreading out."""
        weights = (2.0, 1.0)[: 1 if single else 2] if self.finger else (1.0,) * len(FINGERS)
        unit = (box.height() - between * (len(weights) - 1)) / sum(weights)
        top, out = box.top(), []
        for place, weight in enumerate(weights):
            spread = bool(self.finger) and place == 1
            area = QRectF(box.left(), top, box.width(), unit * weight)
            scale = _spread_scale(self.finger) if spread else _bend_scale(self.finger > 0)
            out.append((Panel(area, scale, *self.shown_s), place))
            top += unit * weight + between
        return out

    def still(self, place: int, key: int) -> list[Mark]:
        words = group_words()[key] if self.finger else finger_name(str(FINGERS[key]))
        return [Scales(), Name(words, above=bool(self.finger) and key == 0)]

    def moving(self, key: int, points: int) -> list[Curve]:
        """The joints of a panel; one bound to another, or never seen, only where there is room for it."""
        out = []
        for figure in self.figures(key):
            series = self.joint_series(figure)
            series = None if series is None else within(series, *self.shown_s)
            if series is None or (not self.finger and bool(series.predicted[np.isfinite(series.value)].all())):
                continue
            out.append(Curve(thinned(series, max(FEWEST_POINTS, points)), figure.token))
        return out

    def columns(self, key: int) -> list[tuple[str, Series]]:
        """Every joint of a panel that is measured or bound."""
        many = [(figure.joint, self.joint_series(figure)) for figure in self.figures(key)]
        return [(name, series) for name, series in many if series is not None]

    def values(self, key: int, time_s: float) -> list[Value]:
        """The joints of a panel that have a number beside it."""
        figures = [figure for figure in self.figures(key) if self.joint_series(figure) is not None]
        shown = figures if self.finger else [figure for figure in figures if not self.is_bound(figure)]
        return [Value(figure.row_name, figure.token, *joint_at(self, figure, time_s)) for figure in shown]


def _joint_series(joints: JointCurves, figure: Figure) -> Series | None:
    name, share, bound = figure.joint, figure.sign, False
    if name not in joints.names and figure.row == "end":
        name, share, bound = f"PIP{figure.finger}_flexion", DIP_PER_PIP, True
    if name not in joints.names:
        return None
    column = joints.names.index(name)
    value, sd = share * joints.angles_deg[:, column], abs(share) * joints.sds_deg[:, column]
    hidden = np.isfinite(value) & (bound | ~joints.seen[:, column])
    return Series(joints.time_s, value, sd, hidden, longest_step_s(joints.time_s))


def _bend_scale(roomy: bool) -> Scale:
    inner = (45.0,) if roomy else ()
    ticks = (90.0, *inner, 0.0)
    labels = tuple((value, f"{written(value)}°") for value in ticks)
    return Scale(_BEND_LOW_DEG, _BEND_HIGH_DEG, ticks, labels, strong_ends=False)


def _spread_scale(finger: int) -> Scale:
    return Scale(-_SPREAD_DEG, _SPREAD_DEG, (20.0, 0.0, -20.0), spread_labels(20.0, finger), strong_ends=False)


def paint_behind(painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]]) -> None:
    """Everything but the curves: repetitions, grid, limits, target, time axis."""
    repetitions = RepetitionMarks(plot.repetitions, plot.current)
    for panel, _ in panels:
        repetitions.paint(painter, style, panel)
    repetitions.paint_numbers(painter, style, panels[0][0])
    for place, (panel, key) in enumerate(panels):
        for mark in plot.still(place, key):
            mark.paint(painter, style, panel)
    Times(axes.time_labels(*plot.shown_s)).paint(painter, style, panels[-1][0])


def paint_session(painter: QPainter, style: PlotStyle, plot: SessionPlot, panels: Sequence[tuple[Panel, int]]) -> None:
    """The whole plot at once, as on paper."""
    paint_behind(painter, style, plot, panels)
    for panel, key in panels:
        Curves(plot.moving(key, int(panel.box.width() / style.unit))).paint(painter, style, panel)


def value_at(curves: ReportCurves, column: int, time_s: float) -> tuple[float, float]:
    """Angle and its deviation in degrees at the frame nearest to a time; NaN in a gap."""
    if not len(curves.time_s):
        return math.nan, math.nan
    row = row_at(curves.time_s, time_s)
    if abs(float(curves.time_s[row]) - time_s) > longest_step_s(curves.time_s):
        return math.nan, math.nan
    return float(curves.angles_deg[row, column]), float(curves.sds_deg[row, column])


def joint_at(plot: HandPlot, figure: Figure, time_s: float) -> tuple[float, float, bool]:
    """Angle, deviation and whether it was hidden at the frame nearest to a time; NaN in a gap."""
    series = plot.joint_series(figure)
    if series is None or not len(series.time_s):
        return math.nan, math.nan, True
    row = row_at(plot.curves.time_s, time_s)
    if abs(float(series.time_s[row]) - time_s) > series.longest_step_s or series.sd is None:
        return math.nan, math.nan, True
    return float(series.value[row]), float(series.sd[row]), bool(series.predicted[row])


def row_at(time_s: FloatArray, at_s: float) -> int:
    """Row of the frame nearest to a time; -1 without any."""
    return int(np.abs(time_s - at_s).argmin()) if len(time_s) else -1


def with_edge(repetition: ShownRepetition, edge: str, time_s: float) -> ShownRepetition:
    """With its ``start`` or ``end`` elsewhere, as far as the other one lets it."""
    if edge == "start":
        return replace(repetition, start_s=min(max(0.0, time_s), repetition.end_s - EDGES_S))
    return replace(repetition, end_s=max(time_s, repetition.start_s + EDGES_S))


def session_table(plot: SessionPlot, keys: Sequence[int]) -> tuple[Sequence[str], Iterable[Sequence[str]]]:
    """One row for each picture that is shown: seconds, and of every curve degrees, their sd, whether measured."""
    placed = [(plot.unit(key), found) for key in keys for found in plot.columns(key)]
    head = ["time_s"]
    for unit, (name, _) in placed:
        head += [f"{name}_{unit}", f"{name}_sd_{unit}", f"{name}_measured"]
    times, (start_s, end_s) = plot.curves.time_s, plot.shown_s
    rows = np.flatnonzero((times >= start_s) & (times <= end_s))

    def cells(row: int) -> list[str]:
        out = [f"{times[row]:.3f}"]
        for _, (_, series) in placed:
            value = float(series.value[row])
            sd = math.nan if series.sd is None else float(series.sd[row])
            out += [written(v, 1) if math.isfinite(v) else "" for v in (value, sd)]
            out.append("" if not math.isfinite(value) else "no" if series.predicted[row] else "yes")
        return out

    return head, (cells(row) for row in rows.tolist())


POINTS_PER_COLUMN = 2


LONGEST_STRETCHES = 3.0
"""Samples that were kept lie up to two stretches apart, a little more where pictures are missing."""


def thinned(series: Series, columns: int) -> Series:
    """At most two samples of each of ``columns`` equal stretches: its smallest and its largest value.

    A stretch without a value keeps one sample of it, so that gaps stay, also those of missing pictures; the widest
    band of a stretch is kept.
    """
    count = len(series.time_s)
    if count <= POINTS_PER_COLUMN * columns:
        return series
    stretch_s = float(np.median(np.diff(series.time_s))) * count / columns
    series = _with_gaps(series)
    count = len(series.time_s)
    size = -(-count // columns)
    rows = -(-count // size)
    first = size * np.arange(rows)
    flat = np.full(rows * size, np.nan)
    flat[:count] = series.value
    value = flat.reshape(rows, size)
    known = np.isfinite(value)
    inside = np.arange(rows * size).reshape(rows, size) < count
    some, gap = known.any(axis=1), (~known & inside).any(axis=1)
    lowest = first + np.where(known, value, np.inf).argmin(axis=1)
    highest = first + np.where(known, value, -np.inf).argmax(axis=1)
    unknown = first + (~known & inside).argmax(axis=1)
    kept = np.zeros(count, dtype=bool)
    for index in (
        lowest[some], highest[some], unknown[gap & some], first[~some], np.minimum(first + size, count)[~some] - 1,
    ):  # fmt: skip
        kept[index] = True
    index = np.flatnonzero(kept)
    sd = None
    if series.sd is not None:
        spread = np.full(rows * size, -np.inf)
        spread[:count] = np.where(np.isfinite(series.sd), series.sd, -np.inf)
        widest = spread.reshape(rows, size).max(axis=1)[index // size]
        sd = np.where(np.isfinite(widest), widest, np.nan)
    return Series(
        series.time_s[index], series.value[index], sd, series.predicted[index],
        max(series.longest_step_s, LONGEST_STRETCHES * stretch_s),
    )  # fmt: skip


def within(series: Series, start_s: float, end_s: float) -> Series:
    """The samples of a stretch of time, with one beyond each end so that the line goes to the edge."""
    first = max(int(np.searchsorted(series.time_s, start_s)) - 1, 0)
    last = int(np.searchsorted(series.time_s, end_s, side="right")) + 1
    if first == 0 and last >= len(series.time_s):
        return series
    part = slice(first, last)
    sd = None if series.sd is None else series.sd[part]
    return Series(series.time_s[part], series.value[part], sd, series.predicted[part], series.longest_step_s)


def _with_gaps(series: Series) -> Series:
    """A sample without a value in the middle of each step that is too long to be joined."""
    before = np.flatnonzero(np.diff(series.time_s) > series.longest_step_s)
    if not len(before):
        return series
    middle_s = 0.5 * (series.time_s[before] + series.time_s[before + 1])
    return Series(
        np.insert(series.time_s, before + 1, middle_s),
        np.insert(series.value, before + 1, np.nan),
        None if series.sd is None else np.insert(series.sd, before + 1, np.nan),
        np.insert(series.predicted, before + 1, False),
        series.longest_step_s,
    )
