"""C3D, read back by two libraries that did not write it."""

from __future__ import annotations

import struct
import tracemalloc
from dataclasses import replace
from pathlib import Path

import c3d
import ezc3d
import numpy as np
import pytest

from carpus.core.formats.c3d import read_c3d, write
from carpus.core.formats.export_item import ExportItem, joint_centres_cam_m
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.types import TrackStatus
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session
from tests.formats.takes import build_take, hand_take, stopping, store_session, wrist_take

pytestmark = pytest.mark.filterwarnings("ignore:No analog data found in file")


def by_c3d(path: Path) -> tuple[list[str], np.ndarray, float]:
    """Labels, points (K, P, 5) and rate."""
    with path.open("rb") as file:
        reader = c3d.Reader(file)
        points = np.array([points for _, points, _ in reader.read_frames()])
        return [label.strip() for label in reader.point_labels], points, reader.point_rate


@pytest.mark.parametrize("make", [wrist_take, hand_take])
def test_c3d_positions_and_residuals_round_trip(make: object, tmp_path: Path) -> None:
    take: ExportItem = make(tmp_path)  # type: ignore[operator]
    session = take.session
    (path,) = write(take, tmp_path / "out")
    labels, points, rate = by_c3d(path)
    names = list(session.header.protocol.markers)
    count = len(names)
    assert labels[:count] == names
    assert rate == 30.0
    assert len(points) == len(session)
    lost = np.asarray(session.status) == TrackStatus.LOST
    seen = np.isfinite(session.markers.measured_px).all(axis=-1)
    assert np.allclose(points[~lost, :count, :3], 1e3 * session.markers.position_cam_m[~lost], atol=1e-3)
    residual = points[:, :count, 3]
    assert (residual[lost] == -1).all()
    assert ((residual > 0) == (seen & ~lost[:, None])).all()
    assert (residual[~lost] >= 0).all()
    if session.header.joint_names:
        assert labels[count:] == [f"J_{name}" for name in names]
        assert np.allclose(points[~lost, count:, :3], 1e3 * joint_centres_cam_m(session)[~lost], atol=1e-2)
        assert (points[~lost, count:, 3] == 0).all(), "a joint centre is never seen"


def test_c3d_second_reader_agrees(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    (path,) = write(take, tmp_path / "out")
    read = ezc3d.c3d(str(path))
    parameters, points = read["parameters"], read["data"]["points"]
    _, other, _ = by_c3d(path)
    known = other[..., 3] >= 0
    assert np.allclose(points[:3].transpose(2, 1, 0)[known], other[..., :3][known])
    assert np.isnan(points[:3].transpose(2, 1, 0)[~known]).all()
    assert ((read["data"]["meta_points"]["residuals"][0].T > 0) == (other[..., 3] > 0)).all()
    assert parameters["POINT"]["UNITS"]["value"] == ["mm"]
    assert parameters["SUBJECTS"]["NAMES"]["value"] == ["Linden 42"]
    assert "right" in parameters["CARPUS"]["FRAME"]["value"][0]
    assert parameters["CARPUS"]["HAND"]["value"] == ["left"]
    assert len(parameters["CARPUS"]["SESSION_SHA256"]["value"][0]) == 64
    event = parameters["EVENT"]
    assert event["LABELS"]["value"] == ["repetition", "note"]
    assert event["CONTEXTS"]["value"] == ["Left", "Left"]
    assert event["TIMES"]["value"][1] == pytest.approx([3 / 30, 7 / 30], abs=1e-5)


def test_c3d_repetitions_are_events(tmp_path: Path) -> None:
    take = build_take(read_session(stopping(tmp_path)))
    (path,) = write(take, tmp_path / "out")
    event = ezc3d.c3d(str(path))["parameters"]["EVENT"]
    said = list(zip(event["LABELS"]["value"], event["DESCRIPTIONS"]["value"], event["TIMES"]["value"][1], strict=True))
    wanted = []
    for number, one in enumerate(take.results.repetitions, 1):
        assert one.row is not None
        for kind in ("start", "peak", "end"):
            time_s = getattr(one.row, f"{kind}_s") + take.session.timestamp_s[0] - take.times.start_s
            wanted.append((f"repetition_{kind}", str(number), pytest.approx(time_s, abs=1e-4)))
    assert [row for row in said if row[0] != "note"] == wanted
    assert len(wanted) == 9


def of_rows(session: Session, rows: np.ndarray, dropped_before: np.ndarray) -> Session:
    """A session of some of its frames."""
    seen = session.markers
    return replace(
        session,
        timestamp_s=session.timestamp_s[rows],
        status=session.status[rows],
        markers=replace(seen, position_cam_m=seen.position_cam_m[rows], measured_px=seen.measured_px[rows]),
        quality=replace(session.quality, dropped_before=dropped_before),
    )


def test_c3d_one_hour_keeps_last_frame(tmp_path: Path) -> None:
    session = read_session(store_session(tmp_path, frames=10))
    count, times = 70_001, 12
    rows = np.arange(count) % 10
    repeated = of_rows(session, rows, np.zeros(count, dtype=np.int64))
    wandering_m = repeated.markers.position_cam_m + 1e-6 * np.arange(count)[:, None, None]
    long = replace(
        repeated,
        timestamp_s=np.arange(count) / 30.0,
        markers=replace(repeated.markers, position_cam_m=wandering_m),
        events=session.events[:1] * (300 - times),
    )
    take = ExportItem(long, build_take(session).results, "long", build_take(session).provenance)
    (path,) = write(take, tmp_path / "out")
    with path.open("rb") as file:
        reader = c3d.Reader(file)
        assert reader.frame_count == count
        assert np.allclose(read_c3d(path).position_m[-1], long.markers.position_cam_m[-1], atol=1e-6)
        assert len(reader.get("EVENT").get("LABELS2").string_array) == 300 - times - 255


def test_c3d_without_frames_is_written(tmp_path: Path) -> None:
    take = build_take(read_session(store_session(tmp_path, frames=0)))
    (path,) = write(take, tmp_path / "out")
    assert path.stat().st_size % 512 == 0


def c3d_with(parameters: bytes) -> bytes:
    """A C3D whose section of parameters holds these bytes and no more."""
    blocks = -(-(4 + len(parameters)) // 512)
    head = bytes((2, 0x50)).ljust(512, b"\0")
    return (head + bytes((1, 0x50, blocks, 84)) + parameters).ljust(512 * (blocks + 1), b"\0")


@pytest.mark.parametrize(
    "parameters",
    [
        # 16 million texts without a sign in them, of three bytes that say so
        bytes((1, 1)) + b"A" + struct.pack("<h", 0) + struct.pack("<bB", -1, 4) + bytes((1, 255, 255, 255)),
        # 4000 parameters whose values are the same 65 kB
        b"".join(
            bytes((1, 1)) + b"A" + struct.pack("<h", 6) + struct.pack("<bB", 1, 2) + bytes((255, 60))
            for _ in range(4000)
        ),
    ],
)
def test_read_c3d_overlapping_values_are_refused(parameters: bytes, tmp_path: Path) -> None:
    path = tmp_path / "bomb.c3d"
    path.write_bytes(c3d_with(parameters))
    tracemalloc.start()
    try:
        with pytest.raises(ReferenceUnreadable, match="damaged"):
            read_c3d(path)
        peak_bytes = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak_bytes < 40 * path.stat().st_size + 1_000_000
