"""The reader gives back what was written, and refuses everything else with one typed fault."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.dates import moment_from_timestamp, to_iso
from carpus.core.model.depth_sensor import D455
from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.session.reader import has_raw, read_detections, read_session
from carpus.core.session.values import Event, Motion, new_header, stack_states
from tests.session.samples import (
    CAMERA,
    CREATED,
    begin_session,
    compute_time,
    make_calibration,
    make_frame,
    make_header,
    write_once,
)

SEEN = dataclasses.replace(CAMERA, sensor=D455, distortion_model="inverse_brown_conrady")

N = 12


@write_once
def write(path: Path, protocol: MarkerProtocol = WRIST6) -> Path:
    with begin_session(path, make_header(protocol), N, SEEN) as session:
        session.add_event(compute_time(2), "note", "ein Wort")
        session.write_motion(stack_states([make_frame(row + 100, protocol) for row in range(N)]))
    return path


def assert_same(left: object, right: object) -> None:
    """Equal in every field, NaN equal to NaN."""
    assert type(left) is type(right)
    for field in dataclasses.fields(left):  # type: ignore[arg-type]
        mine, theirs = getattr(left, field.name), getattr(right, field.name)
        if isinstance(mine, np.ndarray):
            np.testing.assert_allclose(mine, theirs, rtol=1e-14, err_msg=field.name)
        elif dataclasses.is_dataclass(mine) and field.name != "protocol":
            assert_same(mine, theirs)
        elif isinstance(mine, float):
            assert mine == pytest.approx(theirs, nan_ok=True)
        else:
            assert repr(mine) == repr(theirs), field.name


@pytest.mark.parametrize("protocol", [WRIST6, HAND21], ids=lambda protocol: protocol.name)
def test_reader_returns_written_session(tmp_path: Path, protocol: MarkerProtocol) -> None:
    frames = [make_frame(row, protocol) for row in range(N)]
    path = write(tmp_path / "s.h5", protocol)
    session = read_session(path)
    assert session.header == make_header(protocol)
    assert session.camera == SEEN
    with h5py.File(path, "r") as file:
        assert file.attrs["format_version"] == 3, "an older Carpus must not take this lens for plumb_bob"
    assert_same(session.calibration, make_calibration(protocol))
    assert session.calibration.verdict.findings[0].markers == ("MCP2", "MCP3")
    assert_same(session.motion, stack_states(frames))
    assert isinstance(session.smoothed, Motion)
    assert_same(session.smoothed, stack_states([make_frame(row + 100, protocol) for row in range(N)]))
    assert session.status.tolist() == [frame.status for frame in frames]
    assert session.markers.doubted.tolist() == [frame.doubted.tolist() for frame in frames]
    assert session.calibration.straight_fingers == (True, True, False, True, True)
    assert session.quality.dropped_before.tolist() == [frame.dropped_before for frame in frames]
    assert session.quality.nis_dof.tolist() == [frame.nis_dof for frame in frames]
    assert session.events == (Event(compute_time(2), "note", "ein Wort"),)
    assert session.recovered == ""
    table = read_detections(session.path)
    for row, frame in enumerate(frames):
        assert_same(table.get_frame(row), frame.detections)
    assert not has_raw(session.path)


def edit(change: Callable[[h5py.File], object]) -> Callable[[Path], None]:
    def apply(path: Path) -> None:
        with h5py.File(path, "r+") as file:
            change(file)

    return apply


def put(path: str, rows: object, value: object) -> Callable[[Path], None]:
    return edit(lambda file: file[path].__setitem__(rows, value))


def say(**attributes: object) -> Callable[[Path], None]:
    return edit(lambda file: file.attrs.update(attributes))


def replace(file: h5py.File, path: str, data: object) -> None:
    del file[path]
    file[path] = data


def cut(path: Path) -> None:
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])


BAD: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing": (lambda path: path.unlink(), ""),
    "a folder": (lambda path: (path.unlink(), path.mkdir()), "a folder"),
    "text": (lambda path: path.write_text("a session"), "not a session"),
    "empty": (lambda path: path.write_bytes(b""), "not a session"),
    "cut off": (cut, ""),
    "other HDF5": (lambda path: (path.unlink(), h5py.File(path, "w").close()), "not a session"),
    "newer": (
        edit(lambda file: file.attrs.modify("format_version", 4)),
        "format version 4, but this version of Carpus reads up to 3",
    ),
    "no hand": (edit(lambda file: file.attrs.__delitem__("hand")), "hand"),
    "third hand": (say(hand="middle"), "middle"),
    "other protocol": (say(protocol="foot"), "foot"),
    "no zone": (say(created="2026-11-13T15:30:00"), "damaged"),
    "no date": (say(created="yesterday"), "damaged"),
    "settings not JSON": (say(parameters="{"), ""),
    "settings nested": (say(parameters="[" * 900 + "]" * 900), "damaged"),
    "settings nested without end": (say(parameters="[" * 100_000), "damaged"),
    "two lines": (say(subject_id="a\nb"), "damaged"),
    "long name": (say(subject_id="x" * 10_000), "damaged"),
    "no identity": (say(session_id=""), "damaged"),
    "time back": (put("/frames/timestamp", 7, 0.0), "damaged"),
    "time stands still": (put("/frames/timestamp", slice(None), 1.0), "damaged"),
    "unknown time": (put("/frames/timestamp", 7, np.nan), "damaged"),
    "end of time": (put("/frames/timestamp", N - 1, 1e300), "damaged"),
    "unknown status": (put("/frames/status", 3, 200), "damaged"),
    "large angle": (put("/wrist/angles", 3, 1e12), "damaged"),
    "endless angle": (put("/wrist/angles", 3, np.inf), "damaged"),
    "negative sd": (put("/wrist/angles_sd", 3, -0.1), "damaged"),
    "far marker": (put("/markers/position_camera", 3, 1e9), "damaged"),
    "far hand": (put("/calibration/translation", 0, np.inf), "damaged"),
    "event at no time": (put("/events/time", 0, np.nan), "damaged"),
    "no angles": (edit(lambda file: file.__delitem__("/wrist/angles")), "/wrist/angles"),
    "no camera": (edit(lambda file: file.__delitem__("/camera")), ""),
    "no times": (edit(lambda file: file.__delitem__("/frames/timestamp")), ""),
    "rows missing": (edit(lambda file: file["/wrist/angles"].resize(3, axis=0)), "/wrist/angles"),
    "wrong width": (edit(lambda file: replace(file, "/wrist/position", np.zeros((N, 2)))), "/wrist/position"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_reader_other_file_raises_session_unreadable(tmp_path: Path, case: str) -> None:
    path = write(tmp_path / "s.h5")
    spoil, fact = BAD[case]
    spoil(path)
    with pytest.raises(SessionUnreadable) as caught:
        read_session(path)
    assert caught.value.subject == str(path)
    assert fact in caught.value.detail
    assert "\n" not in caught.value.detail


def test_session_header_without_zone_or_with_wrong_joints_raises() -> None:
    header = make_header()
    with pytest.raises(ValueError, match="zone"):
        dataclasses.replace(header, created="2026-11-13T15:30:00")
    with pytest.raises(ValueError, match="joint"):
        dataclasses.replace(header, joint_names=("CMC1_extension",))
    with pytest.raises(ValueError):
        dataclasses.replace(header, parameters="not JSON")
    first, second = (new_header(hand="right", protocol=HAND21) for _ in range(2))
    assert first.session_id != second.session_id


@pytest.mark.parametrize(
    ("parameters", "simulated", "targets_deg"),
    [
        ('{"source": [], "set_up": 3}', False, (np.nan, np.nan)),
        ('{"set_up": {"targets_deg": [Infinity, -1e9]}}', False, (np.nan, np.nan)),
        ('{"source": {"simulated": "yes"}, "set_up": {"targets_deg": ["a", -20]}}', True, (np.nan, -20.0)),
    ],
)
def test_session_header_foreign_parameters_are_ignored(
    tmp_path: Path, parameters: str, simulated: bool, targets_deg: tuple[float, float]
) -> None:
    header = dataclasses.replace(make_header(), parameters=parameters)
    begin_session(tmp_path / "s.h5", header).close()
    found = read_session(tmp_path / "s.h5").header
    assert found.is_simulated == simulated
    np.testing.assert_array_equal(found.targets_deg, targets_deg)


def test_recording_date_ignores_camera_clock() -> None:
    assert moment_from_timestamp(12.25) is None
    assert moment_from_timestamp(float("nan")) is None
    assert moment_from_timestamp(datetime.now(UTC).timestamp() + 7 * 86400.0) is None
    assert moment_from_timestamp(CREATED.timestamp()) == datetime.fromisoformat(to_iso(CREATED)) == CREATED
