"""What a therapist would read wrongly in a recording, pooled over the recordings of a row, and as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray
from carpus.core.simulation.motions import create_motion
from carpus.core.simulation.truth import Truth
from tests.accuracy.pages import rule_table

INSIDE_SD, OUTSIDE_SD = 2.0, 3.0
AT_NEUTRAL_RAD = np.radians(3.0)
_LEAST_FRAMES = 5
_LEAST_SWING_RAD = np.radians(10.0)
_REST_S = 3.0
"""Where nothing swings, so long a stretch is taken for a repetition."""
_LEAST_KNOWN = 0.6
"""Share of a repetition's frames in which an angle must be known."""
_END_S = 0.1
"""The end of a stroke: so long before and after its furthest point."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A angles over N frames; degrees, NaN where nothing is known or compared.

    ``error_deg``, ``sd_deg`` (N, A). ``range_deg`` (R, A) range of motion found minus true in each of R repetitions;
    ``end_deg`` (E, A) errors at the ends of strokes; ``zero_deg`` (A,) mean error while the angle truly is what it was
    in the neutral pose; ``outside_s`` (A,) longest time on end with the truth outside 3 sd. ``unused`` of ``shown``
    discs that were there to be seen were not taken.
    """

    error_deg: FloatArray
    sd_deg: FloatArray
    range_deg: FloatArray
    end_deg: FloatArray
    zero_deg: FloatArray
    outside_s: FloatArray
    unused: int
    shown: int


def compute_reading(
    time_s: FloatArray,
    moves_rad: FloatArray,
    true_rad: FloatArray,
    frames: NDArray[np.bool_],
    error: FloatArray,
    sd_deg: FloatArray,
    *,
    unused: int,
    shown: int,
) -> Reading:
    """Of the scored ``frames`` (N,) of a recording: their times (F,), all that moves in them (F, K), the true angles of
    all frames (N, A), and the errors (F, A) and sds (F, A), degrees."""
    near_neutral = np.abs(true_rad[frames] - true_rad[0]) < AT_NEUTRAL_RAD
    known = near_neutral & np.isfinite(error)
    count = known.sum(axis=0)
    zero = np.where(count >= _LEAST_FRAMES, np.where(known, error, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan)
    windows, ends = find_strokes(time_s, moves_rad)
    true_deg = np.degrees(true_rad[frames])
    ranges = [_range_error(true_deg[w], error[w]) for w in windows]
    at_end = [_middle(error[np.abs(time_s - end) <= _END_S]) for end in ends]
    width = error.shape[1]
    return Reading(
        error,
        sd_deg,
        np.array(ranges).reshape(-1, width),
        np.array(at_end).reshape(-1, width),
        zero,
        longest_each_s(np.abs(error) > OUTSIDE_SD * sd_deg, time_s),
        unused,
        shown,
    )


def find_moves_rad(truth: Truth, time_s: FloatArray) -> FloatArray:
    """All angles (F, K) that the simulated hand moves at these times."""
    motion = create_motion(truth.spec)
    return np.hstack((motion.wrist_angles_rad(time_s), motion.joint_angles_rad(time_s)))


def find_strokes(time_s: FloatArray, moves_rad: FloatArray) -> tuple[list[slice], FloatArray]:
    """Repetitions as slices of ``time_s`` (N,), and the times of the ends of their strokes: both of whatever moves
    furthest of ``moves_rad`` (N, K), wrist or finger, by the middle of its swing."""
    swing = np.ptp(moves_rad, axis=0)
    if swing.max() < _LEAST_SWING_RAD:
        edges = np.arange(time_s[0], time_s[-1] - 0.5 * _REST_S, _REST_S)
        starts = np.searchsorted(time_s, edges).tolist()
        return [slice(a, b) for a, b in zip(starts, [*starts[1:], len(time_s)], strict=True)], np.empty(0)
    driver = moves_rad[:, int(swing.argmax())]
    middle, play = 0.5 * (driver.min() + driver.max()), 0.15 * swing.max()
    rising, is_high = [], bool(driver[0] > middle)
    for i, value in enumerate(driver):
        if not is_high and value > middle + play:
            rising.append(i)
        is_high = bool(value > middle - play) if is_high else bool(value > middle + play)
    starts = rising if len(rising) > 1 else [0, len(time_s)]
    windows = [slice(a, b) for a, b in pairwise(starts)]
    ends = [time_s[w][int(pick(driver[w]))] for w in windows for pick in (np.argmin, np.argmax)]
    return windows, np.array(ends)


def _range_error(true_deg: FloatArray, error_deg: FloatArray) -> FloatArray:
    """Range of motion found minus true (A,) over the frames (N, A) in which the angle is known, if these are enough."""
    known = np.isfinite(error_deg)
    enough = known.mean(axis=0) >= _LEAST_KNOWN
    out = np.full(error_deg.shape[1], np.nan)
    for column in np.flatnonzero(enough):
        true = true_deg[known[:, column], column]
        out[column] = np.ptp(true + error_deg[known[:, column], column]) - np.ptp(true)
    return out


def _middle(values: FloatArray) -> FloatArray:
    """Median (A,) of the frames (N, A); NaN where one is missing."""
    return np.asarray(np.median(values, axis=0)) if len(values) else np.full(values.shape[1], np.nan)


def longest_each_s(outside: NDArray[np.bool_], time_s: FloatArray) -> FloatArray:
    """Longest time on end of each column (N, A), from its first to its last frame."""
    longest, since = np.zeros(outside.shape[1]), np.full(outside.shape[1], np.nan)
    for now_s, flags in zip(time_s, outside, strict=True):
        since = np.where(flags, np.where(np.isnan(since), now_s, since), np.nan)
        longest = np.fmax(longest, now_s - since)
    return longest


@dataclass(frozen=True, slots=True)
class ReadFigures:
    """One column of angles over the recordings of a row, degrees: ``rmse``, ``p95``, ``inside`` share within 2 sd;
    mean and worst error of the range of motion of a repetition, RMS and worst error at the ends of strokes, RMS of
    the zeros; longest time on end outside 3 sd."""

    rmse: float
    p95: float
    inside: float
    range_mean: float
    range_worst: float
    end_rms: float
    end_worst: float
    zero_rms: float
    outside_s: float


def read_figures(readings: Sequence[Reading], columns: Sequence[int]) -> ReadFigures:
    """Figures of some of the angles, taken together."""
    some = list(columns)

    def pooled(values: Sequence[FloatArray]) -> FloatArray:
        flat = np.concatenate([np.atleast_2d(value)[:, some].ravel() for value in values])
        return np.asarray(flat[np.isfinite(flat)])

    error = pooled([reading.error_deg for reading in readings])
    ratio = pooled([np.abs(reading.error_deg) / np.maximum(reading.sd_deg, 1e-9) for reading in readings])
    spans = np.abs(pooled([reading.range_deg for reading in readings]))
    ends = np.abs(pooled([reading.end_deg for reading in readings]))
    zeros = pooled([reading.zero_deg for reading in readings])
    return ReadFigures(
        rmse=rms(error),
        p95=float(np.quantile(np.abs(error), 0.95)) if error.size else float("nan"),
        inside=mean(ratio <= INSIDE_SD),
        range_mean=mean(spans),
        range_worst=_most(spans),
        end_rms=rms(ends),
        end_worst=_most(ends),
        zero_rms=rms(zeros),
        outside_s=_most(pooled([reading.outside_s for reading in readings])),
    )


def unused_share(readings: Sequence[Reading]) -> float:
    """Share of the visible discs that were not used."""
    return sum(reading.unused for reading in readings) / max(1, sum(reading.shown for reading in readings))


def rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")


def mean(values: FloatArray | NDArray[np.bool_]) -> float:
    return float(np.mean(values)) if values.size else float("nan")


def _most(values: FloatArray) -> float:
    return float(values.max()) if values.size else float("nan")


WRIST_COLUMNS: dict[str, tuple[int, ...]] = {"deviation": (0,), "flexion": (1,), "pro/sup": (2,)}


@dataclass(frozen=True, slots=True)
class ReadRow:
    """Recordings that stand in one row; ``columns`` names groups of their angles."""

    name: str
    columns: dict[str, tuple[int, ...]]
    readings: tuple[Reading, ...]

    def figures(self) -> Iterator[tuple[str, ReadFigures]]:
        for name, some in self.columns.items():
            yield name, read_figures(self.readings, some)


_HEAD = ("RMSE", "p95", "in 2 sd %", "range mean", "worst", "ends RMS", "worst", "zero", "out 3 sd s")


def _cells(f: ReadFigures) -> list[str]:
    return [
        _text(f.rmse, 2), _text(f.p95, 2), _text(100 * f.inside, 0), _text(f.range_mean), _text(f.range_worst),
        _text(f.end_rms), _text(f.end_worst), _text(f.zero_rms), _text(f.outside_s, 2),
    ]  # fmt: skip


def _text(value: float, digits: int = 1) -> str:
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def markdown(rows: Sequence[ReadRow]) -> str:
    """One line for every row, the groups of angles side by side in its cells."""
    head = ["row", "recordings", "angles", *_HEAD, "unused discs, %"]
    lines = [head]
    for row in rows:
        found = dict(row.figures())
        cells = [" / ".join(values) for values in zip(*map(_cells, found.values()), strict=True)]
        unused = f"{100 * unused_share(row.readings):.1f}"
        lines.append([row.name, str(len(row.readings)), " / ".join(found), *cells, unused])
    return rule_table(lines)


_PATIENT_HEAD = (
    "hand", "recordings", "deviation", "flexion–extension", "pronation–supination", "MCP", "PIP",
    "truth within 2 SD, %", "error of the range of motion: mean", "largest",
)  # fmt: skip


def patient_rows(kinds: Sequence[tuple[str, Sequence[ReadRow]]]) -> list[tuple[str, ...]]:
    """Head and one row for each kind of hand: RMSE of each angle, degrees, then the worst of the wrist's three angles.

    ``kinds`` are names with their recordings' rows, which are pooled.
    """
    lines: list[tuple[str, ...]] = [_PATIENT_HEAD]
    for name, rows in kinds:
        wrists = [one for row in rows if "deviation" in row.columns for one in row.readings]
        if not wrists:
            continue
        found = [read_figures(wrists, some) for some in WRIST_COLUMNS.values()]
        joints = _joint_rmse([row for row in rows if "MCP flexion" in row.columns])
        worst = min(100.0 * one.inside for one in found)
        ranges = (max(one.range_mean for one in found), max(one.range_worst for one in found))
        lines.append(
            (
                name, str(len(wrists)), *(f"{one.rmse:.2f}" for one in found), *joints,
                f"{worst:.0f}", *(f"{value:.1f}" for value in ranges),
            )
        )  # fmt: skip
    return lines


_JOINTS = ("MCP flexion", "PIP flexion")


def _joint_rmse(rows: Sequence[ReadRow]) -> list[str]:
    """RMSE of MCP and PIP flexion while their markers are visible."""
    if not rows:
        return ["-", "-"]
    readings = [one for row in rows for one in row.readings]
    return [f"{read_figures(readings, rows[0].columns[name]).rmse:.1f}" for name in _JOINTS]
