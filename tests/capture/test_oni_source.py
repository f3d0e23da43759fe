"""Recordings as a source of frames: every picture, in order, at its time; damaged ones left out and counted."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.capture.camera_info import sidecar_path, write_camera_info
from carpus.core.capture.files.oni_format import RecordType
from carpus.core.capture.files.oni_source import OniSource
from carpus.core.model.camera import Camera
from carpus.core.model.errors import (
    CameraFileUnreadable,
    CarpusFault,
    DepthNotRegistered,
    FramesEnlarged,
    RecordingDamaged,
    RecordingUnsupported,
)
from carpus.core.model.types import Frame
from tests.capture.oni_samples import (
    CAMERA,
    HEIGHT,
    PERIOD_S,
    START_S,
    WIDTH,
    Record,
    color_picture,
    depth_picture,
    find,
    patch_bytes,
    rebuilt,
    with_small_color,
    write_sample,
)


def play(path: Path) -> tuple[list[Frame], list[CarpusFault]]:
    notices: list[CarpusFault] = []
    source = OniSource(path, registered=True, notice=notices.append)
    frames = list(source.frames())
    source.close()
    return frames, notices


def change_sample(folder: Path, count: int, change: Callable[[bytes], bytes], **how: Any) -> Path:
    """A sample whose bytes are not as they were written."""
    path = write_sample(folder / "a.oni", count, **how)
    path.write_bytes(change(path.read_bytes()))
    return path


def assert_whole(frames: list[Frame], count: int) -> None:
    assert [frame.index for frame in frames] == list(range(count))
    for number, frame in enumerate(frames, start=1):
        assert np.array_equal(frame.color_rgb, color_picture(number))
        assert np.array_equal(frame.depth_raw, depth_picture(number))
        assert frame.timestamp_s == pytest.approx(START_S + (number - 1) * PERIOD_S, abs=1e-6)
        assert frame.dropped_before == 0
        assert not frame.color_rgb.flags.writeable
        assert frame.color_rgb.flags.c_contiguous


@pytest.mark.parametrize("depth", ["raw", "table"])
def test_oni_source_is_lossless_and_can_be_repeated(tmp_path: Path, depth: Any) -> None:
    source = OniSource(write_sample(tmp_path / "手首 été.oni", 4, depth=depth))
    for _ in range(2):
        assert_whole(list(source.frames()), 4)
    source.close()
    source.close()
    assert list(source.frames()) == []


@pytest.mark.parametrize(("registered", "expected"), [(True, []), (False, [DepthNotRegistered])])
def test_oni_source_uses_sidecar(tmp_path: Path, registered: bool, expected: list[type[CarpusFault]]) -> None:
    path = write_sample(tmp_path / "a.oni", 2)
    write_camera_info(sidecar_path(path), CAMERA, registered=registered)
    notices: list[CarpusFault] = []
    source = OniSource(path, registered=not registered, notice=notices.append)
    assert [type(fault) for fault in notices] == expected
    assert source.info.settings["registered"] == ("yes" if registered else "no")
    assert source.info.camera.origin == "file"
    assert all(frame.depth_raw is not None for frame in source.frames())


def test_oni_source_sidecar_of_other_size_raises(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 2)
    write_camera_info(sidecar_path(path), replace(CAMERA, height_px=40))
    with pytest.raises(CameraFileUnreadable) as caught:
        OniSource(path)
    assert caught.value.subject == str(sidecar_path(path))


def test_oni_source_mirrored_images_are_flipped(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 1, mirrored=True)
    assert_whole(play(path)[0], 1)
    assert OniSource(path).info.settings["mirrored"] == "turned back"
    write_camera_info(sidecar_path(path), CAMERA, registered=True, mirrored=False)
    (frame,) = play(path)[0]
    assert np.array_equal(frame.color_rgb, color_picture(1)[:, ::-1]), "the camera file knows better"
    assert np.array_equal(frame.depth_raw, depth_picture(1)[:, ::-1])


def test_oni_source_small_colour_is_enlarged(tmp_path: Path) -> None:
    path = change_sample(tmp_path, 3, with_small_color)
    small = Camera(26.25, 26.25, 15.5, 11.5, WIDTH // 2, HEIGHT // 2)
    write_camera_info(sidecar_path(path), small, registered=True)
    notices: list[CarpusFault] = []
    source = OniSource(path, notice=notices.append)
    assert [type(fault) for fault in notices] == [FramesEnlarged]
    assert source.info.camera == replace(CAMERA, origin="file")
    frames = list(source.frames())
    assert len(frames) == 3
    for number, frame in enumerate(frames, start=1):
        assert frame.color_rgb.shape == (HEIGHT, WIDTH, 3)
        assert np.array_equal(frame.depth_raw, depth_picture(number))
        # the mean of each 2x2 block is the small pixel, up to the smoothing at edges
        blocks = frame.color_rgb.reshape(HEIGHT // 2, 2, WIDTH // 2, 2, 3).mean((1, 3))
        inner = np.s_[12:-2, 12:-2]
        small_picture = color_picture(number, WIDTH // 2, HEIGHT // 2).astype(float)
        assert np.abs(blocks - small_picture)[inner].mean() < 3.0


def test_oni_source_incompatible_sizes_raise(tmp_path: Path) -> None:
    def narrow_depth(record: Record, fields: bytes, payload: bytes) -> tuple[bytes, bytes]:
        if record.node == 1 and b"xnMapOutputMode\0" in fields:
            fields = fields[:-12] + np.array([60, 48, 30], "<u4").tobytes()
        return fields, payload

    with pytest.raises(RecordingUnsupported) as caught:
        OniSource(change_sample(tmp_path, 2, lambda data: rebuilt(data, narrow_depth)))
    assert caught.value.detail == "colour 64x48, depth 60x48"


def damage_payload(data: bytes, node: int, occurrence: int) -> bytes:
    payload = find(data, RecordType.NEW_DATA, occurrence, node).payload
    noise = np.random.default_rng(3).integers(0, 256, payload.stop - payload.start, np.uint8).tobytes()
    return patch_bytes(data, payload.start, noise)


def test_oni_source_damaged_depth_leaves_frame_without_depth(tmp_path: Path) -> None:
    frames, notices = play(change_sample(tmp_path, 6, lambda data: damage_payload(data, 1, 3)))
    assert [frame.depth_raw is not None for frame in frames] == [True, True, True, False, True, True]
    assert [fault.detail for fault in notices] == ["1 of 6 depth"]


def test_oni_source_changed_file_raises(tmp_path: Path) -> None:
    path = write_sample(tmp_path / "a.oni", 60)
    source = OniSource(path)
    frames = source.frames()
    next(frames)
    os.truncate(path, 100_000)
    for rest in (frames, source.frames()):
        with pytest.raises(RecordingDamaged, match="the file changes while it is read"):
            list(rest)
