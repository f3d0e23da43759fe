"""The thin layer against the real library, in processes of their own: whatever dies there, dies alone."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.capture.devices import openni2
from carpus.core.capture.devices.openni2 import load_library
from carpus.core.capture.files.oni_source import OniSource
from carpus.core.capture.source import PixelFormat, VideoMode
from carpus.core.model.errors import DriverMissing
from tests.capture.oni_samples import HEIGHT, WIDTH, color_picture, depth_picture, write_sample

ROOT = Path(__file__).parents[2]


PRELUDE = """
import json, sys
from carpus.core.capture.devices.openni2 import *

PLAYBACK_SPEED, PLAYBACK_REPEAT, NUMBER_OF_FRAMES = 100, 101, 8

class OpenContext(Context):
    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.api.oniShutdown()

"""
"""What a program needs that plays recordings by the library."""
NO_DEVICE = 6


def run_in_process(body: str, *arguments: str) -> Any:
    """Run ``body`` with the library at hand; what it puts into ``result``."""
    program = f"{PRELUDE}result = None\n{body}\nprint(json.dumps(result))"
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_openni2_missing_library_raises(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(openni2, "LINUX_NAMES", ("libOpenNI2-not-here.so",))
    monkeypatch.setattr(openni2, "LIBRARY_NAMES", {})
    monkeypatch.setenv("OPENNI2_REDIST64", str(tmp_path))
    with pytest.raises(DriverMissing) as caught:
        load_library()
    assert "libOpenNI2-not-here.so" in caught.value.detail

    monkeypatch.setattr(openni2, "LINUX_NAMES", ("libc.so.6",))
    with pytest.raises(DriverMissing):
        load_library()


def test_openni2_open_missing_device_or_unsafe_name_raises() -> None:
    body = """
with OpenContext() as library:
    result = [len(library.list_devices())]
    for name in ("", "/nowhere/none.oni", "手.oni", "a" * 256):
        try:
            library.open(name)
        except OpenNI2Error as failure:
            result.append([failure.call, failure.status, failure.reason])
        except ValueError:
            result.append("kept away")
"""
    devices, default, missing, *unsafe = run_in_process(body)
    assert devices == 0
    assert default[0] == missing[0] == "oniDeviceOpen"
    assert missing[1] == NO_DEVICE
    assert "none.oni" in missing[2]
    assert unsafe == ["kept away", "kept away"]


def test_openni2_recording_plays_in_lockstep_and_is_recorded_again(tmp_path: Path) -> None:
    """What the library reads from our file and writes again holds the same depth and colour.

    Its recorder may lose a picture of its own accord; each one that it wrote must be one of ours.
    """
    first, second = write_sample(tmp_path / "first.oni", 6), tmp_path / "second.oni"
    body = """
import ctypes, time
with OpenContext() as library:
    library.register_disconnect_handler(lambda uri: None)
    device = library.open(sys.argv[1])
    assert device.set_value(PLAYBACK_REPEAT, c_int(0))
    assert device.set_value(PLAYBACK_SPEED, c_float(-1.0))
    streams = [device.create_stream(Sensor.COLOR), device.create_stream(Sensor.DEPTH)]
    recorder = ctypes.c_void_p()
    assert library.api.oniCreateRecorder(sys.argv[2].encode(), ctypes.byref(recorder)) == 0
    for stream in streams:
        assert library.api.oniRecorderAttachStream(recorder, stream.handle, 0) == 0
    library.api.oniRecorderStart(recorder)
    for stream in streams:
        stream.start()
    seen = []
    while (ready := library.poll_streams(streams, 500)) is not None:
        with streams[ready].read_frame() as picture:
            seen.append([picture.sensor, picture.index, picture.timestamp_us, picture.width_px, picture.size_bytes])
            time.sleep(0.03)  # its recorder has one place for the picture to come: let it write
    mode = streams[0].read_mode()
    result = [seen, [mode.pixel_format, mode.width_px, mode.height_px, mode.fps],
              device.can_register_depth(), streams[1].get_value(StreamProperty.HORIZONTAL_FOV, c_float()),
              streams[1].get_value(NUMBER_OF_FRAMES, c_int()), streams[1].set_int(StreamProperty.MIRRORING, 0)]
    time.sleep(0.3)
    library.api.oniRecorderStop(recorder)
    library.api.oniRecorderDestroy(ctypes.byref(recorder))
    device.close()
"""
    seen, mode, can_register, view, count, settable = run_in_process(body, str(first), str(second))
    assert [row[:2] for row in seen] == [[sensor, number] for number in range(1, 7) for sensor in (2, 3)]
    assert [row[2] for row in seen[:2]] == [10000, 13000]
    sizes = {(2, WIDTH, WIDTH * HEIGHT * 3), (3, WIDTH, WIDTH * HEIGHT * 2)}
    assert {(row[0], row[3], row[4]) for row in seen} == sizes
    assert VideoMode(*mode) == VideoMode(PixelFormat.RGB888, WIDTH, HEIGHT, 30)
    assert (can_register, count, settable) == (False, 6, False)
    assert view == pytest.approx(1.0947857, abs=1e-5)
    back = list(OniSource(second).frames())
    assert back, "not one was written"
    ours = {color_picture(number).tobytes() for number in range(1, 7)}
    assert {frame.color_rgb.tobytes() for frame in back} <= ours
    for depth in [frame.depth_raw for frame in back if frame.depth_raw is not None]:
        assert np.array_equal(depth, depth_picture(int(depth[0, 0]) - 5000))
