"""One account of the repetitions: in the file, in what is shown of it, and after a person's choices."""

from __future__ import annotations

import math
import shutil
from dataclasses import astuple, replace
from itertools import product
from pathlib import Path

import h5py
import numpy as np
import pytest
from numpy.lib.recfunctions import repack_fields

from carpus.core.measures.motion_range import motion_range
from carpus.core.measures.repetitions import Repetition, RepetitionAnalysis, Stroke, find_repetitions
from carpus.core.measures.signals import Signal, resample_evenly
from carpus.core.results.repetition_rows import (
    HIDDEN,
    RepetitionChoices,
    TrainedAngle,
    compute_repetitions,
    measure_repetitions,
    with_time_offset,
)
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.session_summary import repetition_lines
from carpus.core.session.reader import read_session, verify
from carpus.core.session.values import RepetitionRow, Session
from tests.formats.takes import stopping
from tests.ui.fakes import session as simulated


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return stopping(tmp_path_factory.mktemp("repetitions"))


@pytest.fixture(scope="module")
def session(path: Path) -> Session:
    return read_session(path)


def test_repetitions_pause_is_in_file(path: Path, session: Session) -> None:
    with h5py.File(path) as file:
        table = file["/repetitions"]
        assert table.fletcher32
        assert table.attrs["angle"] == "flexion"
        units = dict(zip(table.dtype.names, table.attrs["column_units"], strict=True))
        rows = table[()]
    assert verify(path).has_checksum
    assert {units[name] for name in ("start", "peak", "end", "pause_time")} == {"s"}
    assert (units["arc"], units["peak_speed"]) == ("rad", "rad/s")
    assert len(rows) == 3
    first = float(session.timestamp_s[0])
    for k, row in enumerate(rows):
        # A second of rest, 2.2 s up with a stop, one second of hold, one back; 5 % of the peak 5.9 % into a movement.
        begun = first + 5.2 * k + 1.0
        assert row["start"] == pytest.approx(begun + 0.0594 * 0.8, abs=0.06)
        assert row["peak"] == pytest.approx(begun + 2.2 + 0.5, abs=0.05), "the middle of the hold"
        assert row["end"] == pytest.approx(begun + 4.2 - 0.0594, abs=0.04)
        assert np.degrees([row["angle"], row["arc"]]) == pytest.approx([50.0, 50.0], abs=0.2)
        assert math.degrees(row["peak_speed"]) == pytest.approx(1.875 * 50.0, rel=0.03)
        assert row["movement_time"] == pytest.approx(2.2 - 2 * 0.0594 * 0.8 + 1.0 - 2 * 0.0594, abs=0.06)
        assert row["sparc"] == pytest.approx(0.5 * (-3.62 - 1.40), abs=0.1)
        assert (row["pauses"], row["movement_units"]) == (1.0, 3.0)
        assert row["pause_time"] == pytest.approx(0.74, abs=0.05)
        assert row["counted"] == 1
        assert row["reason"] == b""


@pytest.mark.parametrize("which", ["stopping", "both sides"])
def test_repetitions_of_file_results_and_recount_agree(which: str, session: Session) -> None:
    chosen = session if which == "stopping" else simulated()
    found = compute_repetitions(chosen)
    shown = compute_session_results(chosen).repetitions
    start_s = float(chosen.timestamp_s[0])
    assert len(found.rows) == len(shown) >= 3
    for row, one in zip(found.rows, shown, strict=True):
        assert one.row is not None
        assert astuple(with_time_offset(one.row, start_s)) == pytest.approx(astuple(row), nan_ok=True)
        assert (one.start_s + start_s, one.end_s + start_s) == pytest.approx((row.start_s, row.end_s))
        assert row.start_s < row.peak_s < row.end_s
    if which == "stopping":
        assert list(map(astuple, chosen.repetitions.rows)) == [
            pytest.approx(astuple(row), nan_ok=True) for row in found.rows
        ]


def test_repetition_hardly_seen_is_hidden(session: Session) -> None:
    time_s = session.timestamp_s - session.timestamp_s[0]
    status = np.asarray(session.status).copy()
    status[(time_s > 6.5) & (time_s < 7.4) | (time_s > 7.6) & (time_s < 8.5)] = 1
    rows = compute_repetitions(replace(session, status=status)).rows
    assert [row.reason for row in rows] == ["", HIDDEN, ""]
    assert [row.counted for row in rows] == [True, False, True]


def test_session_summary_has_line_per_repetition(session: Session) -> None:
    lines = repetition_lines(compute_session_results(session, RepetitionChoices({1: "pain"})))
    assert len(lines) == 3
    assert "arc 50.0 deg" in lines[0]
    assert "SPARC -2.5" in lines[0]
    assert "1 stops of 0.7 s in all" in lines[0]
    assert "not counted: pain" in lines[1]


def trained_in(knots_s: list[float], knots_deg: list[float], found: RepetitionAnalysis | None = None) -> TrainedAngle:
    """Straight ways between knots, with noise."""
    time_s = np.arange(0.0, knots_s[-1], 1 / 60)
    noise_deg = np.random.default_rng(4).normal(0.0, 0.2, len(time_s))
    angle = resample_evenly(time_s, np.radians(np.interp(time_s, knots_s, knots_deg) + noise_deg))
    sd = replace(angle, value=np.full(len(angle.value), 0.01))
    return train(angle, sd, found)


def train(
    angle: Signal, sd: Signal, found: RepetitionAnalysis | None = None, *, smoothed: bool = False
) -> TrainedAngle:
    detected = found or find_repetitions(angle)
    return TrainedAngle("flexion", detected, angle, sd, angle, smoothed, lambda some: motion_range(angle, sd, some))


def test_repetitions_of_motion_to_both_sides() -> None:
    # Up and down about the middle, with holds of 0.6 s in which noise says where the turn is.
    knots_s = np.cumsum([0.0, 1.0, *[0.8, 0.6] * 6, 0.8, 2.0])
    knots_deg = [0.0, 0.0, *[side for side in (40.0, -40.0) * 3 for _ in range(2)], 0.0, 0.0]
    trained = trained_in(knots_s.tolist(), knots_deg)
    rows = [one.row for one in measure_repetitions(trained, RepetitionChoices())]
    assert len(rows) == 3
    for k, row in enumerate(rows):
        high_s, low_s = 2.1 + 2.8 * k, 3.5 + 2.8 * k
        assert row.start_s < high_s - 0.3
        assert low_s + 0.3 < row.end_s
        assert row.peak_s == pytest.approx(high_s, abs=0.3), "its first turn, and not on either side by chance"
        assert math.degrees(row.angle_rad) == pytest.approx(40.0, abs=1.0)
    # From rest and back to it are ways, too: of 0.8 s each, whose corners a low-pass rounds.
    assert [row.movement_time_s for row in rows] == pytest.approx([2.0, 1.6, 2.0], abs=0.45)


def test_repetition_arc_limited_by_view_is_lower_bound() -> None:
    knots_deg = [0.0, 0.0, 50.0, 50.0, 0.0, 0.0, 50.0, 50.0, 0.0, 0.0]
    trained = trained_in([0.0, 1.0, 2.0, 2.5, 3.5, 4.0, 5.0, 5.5, 6.5, 8.0], knots_deg)
    hidden = (trained.measured.time_s > 2.05) & (trained.measured.time_s < 2.45)
    seen = resample_evenly(trained.measured.time_s, trained.measured.value, ~hidden)
    trained = replace(trained, measured=seen, measure_range=lambda some: motion_range(seen, trained.measured_sd, some))
    rows = [one.row for one in measure_repetitions(trained, RepetitionChoices())]
    assert [row.at_least for row in rows] == [True, False]
    assert all(row.counted for row in rows)


def test_repetitions_without_lower_bounds_are_read(path: Path, session: Session, tmp_path: Path) -> None:
    old = tmp_path / "old.h5"
    shutil.copy(path, old)
    with h5py.File(old, "r+") as file:
        table = file["/repetitions"]
        names = [name for name in table.dtype.names if name != "at_least"]
        rows, attributes = table[()][names], dict(table.attrs)
        del file["/repetitions"]
        made = file.create_dataset("/repetitions", data=repack_fields(rows))
        made.attrs.update(attributes)
    assert read_session(old).repetitions == session.repetitions


@pytest.mark.parametrize(
    ("by", "ends"),
    # Who begins with a hold goes from there and back to it: a start in it cuts nothing.
    [*product(("gap", "end", "start"), ("way out", "nearly back")), ("gap", "at the middle"), ("end", "a hold")],
)
def test_repetition_cut_in_half_is_listed_not_counted(by: str, ends: str) -> None:
    one = np.radians(60.0) * (0.5 - 0.5 * np.cos(2 * np.pi * np.arange(0.0, 1.0, 1 / 120)))  # there and back in 4 s
    still = np.zeros(30)
    piece = one[: {"way out": 40, "at the middle": 90, "nearly back": 96, "a hold": 60}[ends]]
    if ends == "a hold":
        piece = np.concatenate((piece, np.full(30, np.radians(60.0))))
    after = np.concatenate((np.tile(one, 3), still))
    value = np.concatenate((still, np.tile(one, 3), piece, np.full(60, np.nan) if by == "gap" else [], after))
    if by == "end":
        value = value[: -len(after)]
    if by == "start":
        value = np.concatenate((piece[::-1], still, np.tile(one, 3), still))
    time_s = np.arange(len(value)) / 30.0
    angle, sd = resample_evenly(time_s, value), resample_evenly(time_s, np.full(len(value), 0.01))
    measured = measure_repetitions(train(angle, sd), RepetitionChoices())
    rows = [each.row for each in measured]
    whole = [row for row in rows if row.counted]
    (cut,) = [row for row in rows if not row.counted]
    assert cut.reason == f"cut_by_{by}"
    assert math.isnan(cut.arc_rad)
    assert math.isnan(cut.peak_speed_rad_s)
    assert len(whole) == {"gap": 6, "end": 3, "start": 3}[by]
    for row in whole:
        assert row.end_s - row.start_s == pytest.approx(4.0, abs=0.6)
        assert math.degrees(row.arc_rad) == pytest.approx(60.0, abs=0.5)
        assert row.movement_time_s == pytest.approx(4.0, rel=0.15)
    seen_until_s = time_s[30 + 3 * 120 + len(piece) - 1]
    edge_s = cut.start_s if by == "start" else cut.end_s - seen_until_s
    assert edge_s == pytest.approx(0.0, abs=1e-6), "to the last picture"
    # Its quickest moment may be in what was not seen.
    short = [stroke for each in measured for stroke in each.strokes]
    assert all(math.isnan(each.peak_speed_rad_s) or each.stroke.end_s - each.stroke.start_s > 1.8 for each in short)


def test_repetition_moved_edges_exclude_cut() -> None:
    trained = trained_in([0.0, 1.0, 3.0, 5.0, 7.0, 9.0, 10.0], [0.0, 0.0, 50.0, 0.0, 50.0, 0.0, 0.0])
    tracked = replace(trained.tracked, value=np.where(np.abs(trained.tracked.time_s - 8.0) < 0.45, np.nan, 0.3))
    whole = Repetition(5.0, 9.0, 0.55)
    piece = Repetition(1.0, 5.0, 1.0, "cut_by_gap", 5.0)
    trained = replace(trained, tracked=tracked, detected=RepetitionAnalysis((whole,), (), (piece,)))

    def reasons(edges_s: dict[int, tuple[float, float]]) -> list[str]:
        return [each.row.reason for each in measure_repetitions(trained, RepetitionChoices({}, edges_s))]

    assert reasons({}) == ["cut_by_gap", HIDDEN]
    assert reasons({1: (5.0, 7.4)}) == ["cut_by_gap", ""], "what is left was seen"
    assert reasons({0: (1.2, 4.8), 1: (7.0, 9.0)}) == ["", HIDDEN]
    assert reasons({0: (1.2, 5.0)}) == ["cut_by_gap", HIDDEN]


@pytest.mark.parametrize(("edges_s", "peak_s"), [((1.0, 5.0), 3.0), ((1.0, 2.5), math.nan), ((3.5, 5.0), math.nan)])
def test_peak_at_chosen_edge_is_unknown(edges_s: tuple[float, float], peak_s: float) -> None:
    whole = RepetitionAnalysis((Repetition(1.0, 5.0, 1.0),), (Stroke(1.0, 3.0, True), Stroke(3.0, 5.0, False)))
    trained = trained_in([0.0, 1.0, 3.0, 5.0, 7.0], [0.0, 0.0, 50.0, 0.0, 0.0], whole)
    (one,) = measure_repetitions(trained, RepetitionChoices(edges_s={0: edges_s}))
    assert one.row.peak_s == pytest.approx(peak_s, abs=0.2, nan_ok=True)


def test_peak_is_at_turn_when_return_goes_further() -> None:
    whole = RepetitionAnalysis((Repetition(1.0, 5.0, 1.0),), (Stroke(1.0, 2.4, True), Stroke(2.4, 5.0, False)))
    trained = trained_in([0.0, 1.0, 2.0, 2.8, 4.4, 5.5], [0.0, 0.0, 50.0, 50.0, -60.0, -60.0], whole)
    (one,) = measure_repetitions(trained, RepetitionChoices())
    assert one.row.peak_s == pytest.approx(2.4, abs=0.2)
    assert math.degrees(one.row.angle_rad) == pytest.approx(50.0, abs=1.0)


def rows_of(way_deg: dict[float, float], hidden: tuple[float, float] = (0.0, 0.0)) -> list[RepetitionRow]:
    """Of minimum-jerk ways between angles (deg) at times (s), without noise, part of it hidden."""
    knots_s, knots_deg = np.array(list(way_deg)), np.array(list(way_deg.values()))
    time_s = np.arange(0.0, knots_s[-1], 1 / 30)
    at = np.clip(np.searchsorted(knots_s, time_s, side="right") - 1, 0, len(knots_s) - 2)
    share = (time_s - knots_s[at]) / np.diff(knots_s)[at]
    value = knots_deg[at] + np.diff(knots_deg)[at] * (10 * share**3 - 15 * share**4 + 6 * share**5)
    seen = ~((time_s > hidden[0]) & (time_s < hidden[1]))
    angle = resample_evenly(time_s, np.radians(value), seen)
    sd = resample_evenly(time_s, np.full(len(time_s), np.radians(0.3)), seen)
    return [one.row for one in measure_repetitions(train(angle, sd, smoothed=True), RepetitionChoices())]


def test_gap_on_the_way_adds_no_rest() -> None:
    back = {0.0: 0.0, 1.0: 0.0, 2.0: 60.0, 3.0: 0.0, 14.0: 0.0, 15.0: 60.0, 16.0: 0.0, 17.0: 0.0}
    row = rows_of(back, (2.3, 2.7))[0]
    assert row.counted
    assert row.end_s == pytest.approx(2.94, abs=0.2)
    there = {0.0: 0.0, 11.0: 0.0, 12.0: 60.0, 13.0: 0.0, 14.0: 0.0, 15.0: 60.0, 16.0: 0.0, 17.0: 0.0}
    assert rows_of(there, (11.3, 11.7))[0].start_s == pytest.approx(11.06, abs=0.2)
    assert math.isnan(rows_of(back, (2.6, 3.1))[0].end_s), "when it came to rest was hidden"


@pytest.mark.parametrize(("hidden", "known"), [((1.55, 2.45), False), ((1.87, 2.13), False), ((1.2, 1.5), True)])
def test_peak_hidden_by_gap_has_no_time(hidden: tuple[float, float], known: bool) -> None:
    row = rows_of({0.0: 0.0, 1.0: 0.0, 2.0: 60.0, 3.0: 0.0, 4.0: 0.0, 5.0: 60.0, 6.0: 0.0, 7.0: 0.0}, hidden)[0]
    assert math.isfinite(row.peak_s) == known


def test_repetition_stopping_half_way_does_not_count() -> None:
    way = {0.0: 0.0, 1.0: 0.0, 2.0: 60.0, 3.0: 60.0, 4.0: 0.0, 5.0: 0.0}
    for stop_deg in (22.0, 30.0, 40.0):
        rows = rows_of(way | {6.0: stop_deg, 9.0: stop_deg})
        assert [(row.counted, row.reason) for row in rows] == [(True, ""), (False, "cut_by_end")]
    assert len(rows_of(way | {6.0: 12.0, 9.0: 12.0})) == 1, "too little to be on its way"
