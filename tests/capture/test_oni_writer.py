"""Recordings written by Carpus: refused misuse, and what the library's own recorder makes of them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.camera_info import read_camera_info, sidecar_path
from carpus.core.capture.files.oni_source import OniSource, read_contents
from carpus.core.capture.source import is_simulated
from carpus.core.model.errors import RecordingDamaged
from carpus.core.model.types import Frame
from tests.capture.oni_samples import CAMERA, PERIOD_S, color_picture, depth_picture, write_sample
from tests.capture.oni_writer import OniWriter, write_oni

ROOT = Path(__file__).parents[2]


def frames(count: int, depth_unit_m: float = 1e-3) -> list[Frame]:
    return [Frame(i, 100.0 + i * PERIOD_S, color_picture(i), depth_picture(i), depth_unit_m) for i in range(count)]


@pytest.mark.parametrize("simulated", [False, True])
def test_oni_writer_simulated_source_is_in_sidecar(tmp_path: Path, simulated: bool) -> None:
    path = tmp_path / "take.oni"
    write_oni(path, frames(2), CAMERA, simulated=simulated)
    assert is_simulated(OniSource(path).info) == simulated


@pytest.mark.parametrize("mirrored", [False, True])
def test_oni_writer_frames_and_camera_are_read_back(tmp_path: Path, mirrored: bool) -> None:
    path = tmp_path / "take 1.oni"
    assert write_oni(path, frames(5), CAMERA, color="raw", mirrored=mirrored) == 5
    told = read_camera_info(sidecar_path(path))
    assert (told.registered, told.mirrored) == (True, mirrored)
    source = OniSource(path)
    assert (source.info.camera.fx_px, source.info.camera.origin) == (CAMERA.fx_px, "file")
    back = list(source.frames())
    assert len(back) == 5
    for written, read in zip(frames(5), back, strict=True):
        assert np.array_equal(read.color_rgb, written.color_rgb)
        assert read.depth_raw is not None
        assert np.array_equal(read.depth_raw, written.depth_raw)
        assert read.timestamp_s == pytest.approx(written.timestamp_s, abs=1e-6)


def test_oni_writer_100_um_depth_is_read_back(tmp_path: Path) -> None:
    path = tmp_path / "fine.oni"
    write_oni(path, frames(2, 1e-4), CAMERA)
    assert {frame.depth_unit_m for frame in OniSource(path).frames()} == {1e-4}


def test_oni_writer_frames_without_depth_are_read_back(tmp_path: Path) -> None:
    some = [Frame(f.index, f.timestamp_s, f.color_rgb, f.depth_raw if f.index != 1 else None, 1e-3) for f in frames(3)]
    write_oni(tmp_path / "holes.oni", some, CAMERA)
    back = list(OniSource(tmp_path / "holes.oni").frames())
    assert [frame.depth_raw is not None for frame in back] == [True, False, True]


def test_oni_writer_agrees_with_openni2_recorder(tmp_path: Path) -> None:
    """What the library reads from our file and writes again holds the same depth and colour.

    Its recorder may lose a picture of its own accord; each one that it wrote must be one of ours.
    """
    first, second = write_sample(tmp_path / "first.oni", 6), tmp_path / "second.oni"
    program = """
import ctypes, sys, time
from carpus.core.capture.devices.openni2 import *
with Context() as library:
    c = library.api
    device = library.open(sys.argv[1])
    device.set_int(DeviceProperty.PLAYBACK_REPEAT, 0)
    device.set_float(DeviceProperty.PLAYBACK_SPEED, -1.0)
    streams = [device.create_stream(Sensor.COLOR), device.create_stream(Sensor.DEPTH)]
    recorder = ctypes.c_void_p()
    assert c.oniCreateRecorder(sys.argv[2].encode(), ctypes.byref(recorder)) == 0
    for stream in streams:
        assert c.oniRecorderAttachStream(recorder, stream.handle, 0) == 0
    c.oniRecorderStart(recorder)
    for stream in streams:
        stream.start()
    while (ready := library.poll_streams(streams, 500)) is not None:
        with streams[ready].read_frame():
            time.sleep(0.03)  # its recorder has one place for the picture to come: let it write
    time.sleep(0.3)
    c.oniRecorderStop(recorder)
    c.oniRecorderDestroy(ctypes.byref(recorder))
    device.close()
"""
    subprocess.run([sys.executable, "-c", program, str(first), str(second)], cwd=ROOT, check=True, timeout=60)
    back = list(OniSource(second).frames())
    assert back, "not one was written"
    ours = {color_picture(number).tobytes() for number in range(1, 7)}
    assert {frame.color_rgb.tobytes() for frame in back} <= ours
    for depth in [frame.depth_raw for frame in back if frame.depth_raw is not None]:
        assert np.array_equal(depth, depth_picture(int(depth[0, 0]) - 5000))


def test_oni_writer_unfinished_file_raises(tmp_path: Path) -> None:
    path = tmp_path / "torn.oni"
    writer = OniWriter(path, CAMERA)
    writer.add_color(color_picture(1), 0.1)
    writer.abandon()
    with pytest.raises(RecordingDamaged) as caught:
        read_contents(path)
    assert "not finished" in caught.value.detail
