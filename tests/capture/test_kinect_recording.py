"""Recordings of Azure Kinect and Femto: files written byte by byte here, read by PyAV."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from carpus.app.sources import open_recording
from carpus.core.camera import Camera
from carpus.core.capture.files import kinect_recording
from carpus.core.capture.files.kinect_recording import DepthOnColor, KinectRecording, read_calibration
from carpus.core.depth_sensor import AZURE_KINECT
from carpus.core.errors import CarpusFault, ExtraMissing, PicturesLost, RecordingDamaged, RecordingUnsupported
from carpus.core.words import one_sentence
from tests.capture import matroska_writer

COLOR_PX, DEPTH_PX = (1280, 720), (320, 288)
COLOR = [0.4968, 0.5109, 0.4709, 0.6274, 0.4, -0.1, 0.05, 0.1, -0.05, 0.02, 0.0, 0.0, -0.0001, 0.0008]
DEPTH = [0.5123, 0.4945, 0.4921, 0.4922, 0.3, 0.1, 0.01, 0.25, 0.1, 0.02, 0.0, 0.0, -0.00005, 0.00008]
TILT_RAD = 0.1
TURN = [[1.0, 0.0, 0.0], [0.0, np.cos(TILT_RAD), np.sin(TILT_RAD)], [0.0, -np.sin(TILT_RAD), np.cos(TILT_RAD)]]
SHIFT_M = [-0.032, -0.002, 0.004]
NEAR_MM, FAR_MM = 600, 900
FRAMES = 6


def calibration(**changes: Any) -> bytes:
    def camera(purpose: str, values: Sequence[float], turn: Any, shift_m: Sequence[float]) -> dict[str, Any]:
        lens = {"ModelParameters": list(values), "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"}
        pose = {"Rotation": np.ravel(turn).tolist(), "Translation": list(shift_m)}
        return {"Purpose": f"CALIBRATION_CameraPurpose{purpose}", "Intrinsics": lens | changes, "Rt": pose}

    cameras = [camera("Depth", DEPTH, np.eye(3), [0.0] * 3), camera("PhotoVideo", COLOR, TURN, SHIFT_M)]
    return json.dumps({"CalibrationInformation": {"Cameras": cameras}}).encode() + b"\0"


def square(size_px: tuple[int, int]) -> np.ndarray:
    """Depth of a near square before a far plane, off the middle, big-endian as it is stored."""
    depth = np.full(size_px[::-1], FAR_MM, ">u2")
    depth[80:130, 190:260] = NEAR_MM
    depth[:40] = 0
    return depth


def record(
    path: Path, *, without: str = "", calibrated: bytes | None = None, spoilt: int = -1, told_us: float = 0.0
) -> Path:
    ok, jpeg = cv2.imencode(".jpg", np.full((*COLOR_PX[::-1], 3), (30, 60, 120), np.uint8))
    assert ok
    tracks = {
        "COLOR": (1, COLOR_PX, b"MJPG", 24, jpeg.tobytes()),
        "DEPTH": (2, DEPTH_PX, b"b16g", 16, square(DEPTH_PX).tobytes()),
        "IR": (3, DEPTH_PX, b"b16g", 16, square(DEPTH_PX).tobytes()),
    }
    entries = [
        matroska_writer.track(number, name, size_px, fourcc, bits)
        for name, (number, size_px, fourcc, bits, _) in tracks.items()
        if name != without
    ]
    blocks = [
        (round(at * 1e6 / 30.0) + 120 * number, number, b"spoilt" if (at, name) == (spoilt, "COLOR") else picture)
        for at in range(FRAMES)
        for name, (number, *_, picture) in tracks.items()
        if name != without
    ]
    files = [] if without == "calibration" else [("calibration.json", calibration())]
    tags = [("K4A_DEPTH_MODE", "NFOV_2X2BINNED"), ("K4A_DEVICE_SERIAL_NUMBER", "000123")]
    matroska_writer.write(path, entries, blocks, files=files, tags=tags, duration_us=told_us)
    return path


def test_a_recording_is_read_with_depth_where_colour_shows_it(tmp_path: Path) -> None:
    path = record(tmp_path / "take.mkv", told_us=FRAMES * 1e6 / 30.0)
    source = open_recording(path)
    assert isinstance(source, KinectRecording)
    info = source.info
    assert (info.settings["serial"], info.settings["depth"]) == ("000123", "320x288 NFOV_2X2BINNED")
    assert (info.sensor, info.camera.distortion_model, info.has_depth) == (AZURE_KINECT, "rational_polynomial", True)
    frames = list(source.frames())
    assert len(frames) == len(list(source.frames())) == FRAMES, "and a second walk"
    assert [frame.timestamp_s for frame in frames] == pytest.approx(
        [at / 30.0 + 120e-6 for at in range(FRAMES)], abs=2e-6
    )
    assert [frame.dropped_before for frame in frames] == [0] * FRAMES
    first = frames[0]
    assert first.color_rgb[300, 600] == pytest.approx([120, 60, 30], abs=3)
    assert first.depth_raw is not None
    # the square's corners, by OpenCV from the depth camera's pixels to the colour camera's
    lens = read_calibration(calibration(), COLOR_PX, DEPTH_PX)
    corners = np.array([[190.0, 80.0], [259.0, 80.0], [259.0, 129.0], [190.0, 129.0]])
    flat = cv2.undistortPoints(corners.reshape(-1, 1, 2), lens.depth.matrix, np.array(lens.depth.distortion))[:, 0]
    points_m = np.column_stack([flat, np.ones(4)]) * NEAR_MM / 1000.0
    turn, _ = cv2.Rodrigues(np.array(TURN))
    seen, _ = cv2.projectPoints(points_m, turn, np.array(SHIFT_M), info.camera.matrix, np.array(info.camera.distortion))
    (left, top), (right, bottom) = seen[:, 0].min(axis=0), seen[:, 0].max(axis=0)
    near = (first.depth_raw > 0) & (first.depth_raw < (NEAR_MM + FAR_MM) // 2)
    rows, columns = np.nonzero(near)
    pixel = info.camera.fx_px / lens.depth.fx_px  # so wide is one of the depth camera's
    found = [columns.min(), rows.min(), columns.max(), rows.max()]
    assert found == pytest.approx([left, top, right, bottom], abs=pixel + 1.0)
    inside = near[int(top) + 6 : int(bottom) - 5, int(left) + 6 : int(right) - 5]
    assert inside.all(), "holes in the near square"
    depth_mm = (np.array(TURN) @ points_m.mean(axis=0) + SHIFT_M)[2] * 1000.0
    middle = seen[:, 0].mean(axis=0).astype(int)
    assert first.depth_raw[middle[1], middle[0]] == pytest.approx(depth_mm, abs=3.0)
    source.close()
    assert list(source.frames()) == []


def test_the_maker_s_figures_become_pixels_as_its_own_library_says() -> None:
    """A published pair: the file's shares, and what the maker's library made of them for 640x576 and 1920x1080."""
    told = json.loads(calibration().rstrip(b"\0"))
    for camera, values in zip(
        told["CalibrationInformation"]["Cameras"],
        (
            [0.5122697949409485, 0.49451231956481934, 0.4921168386936188, 0.4921667277812958],
            [0.4967627227306366, 0.5108628273010254, 0.470907062292099, 0.6274453997612],
        ),
        strict=True,
    ):
        camera["Intrinsics"]["ModelParameters"][:4] = values
    lens = read_calibration(json.dumps(told).encode(), (1920, 1080), (640, 576))
    for camera, expected in (
        (lens.depth, (503.927643, 503.978729, 332.064270, 325.880615)),
        (lens.color, (904.141541, 903.521362, 953.284424, 555.142456)),
    ):
        assert (camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px) == pytest.approx(expected, abs=1e-3)
    assert lens.color.distortion[2:4] == (COLOR[13], COLOR[12])


@pytest.mark.parametrize(
    ("without", "said"),
    [("COLOR", "no colour pictures"), ("DEPTH", "no depth pictures"), ("calibration", "no calibration")],
)
def test_what_a_recording_lacks_is_told(tmp_path: Path, without: str, said: str) -> None:
    with pytest.raises(RecordingUnsupported) as told:
        open_recording(record(tmp_path / "take.mkv", without=without))
    assert said in one_sentence(told.value)


@pytest.mark.parametrize(
    "text",
    [
        b"", b"[]", b"{}", b"[" * 100_000,
        calibration(ModelParameters=[1.0] * 3), calibration(ModelParameters=[float("nan")] * 14),
        calibration(ModelType="CALIBRATION_LensDistortionModelRational6KT"),
        calibration().replace(b"0.004", b'"a"'), calibration().replace(b'"Rotation": [1.0', b'"Rotation": [2.0'),
    ],
)  # fmt: skip
def test_a_calibration_of_another_form_is_told(text: bytes) -> None:
    with pytest.raises(ValueError, match="not in the maker's form"):
        read_calibration(text, COLOR_PX, DEPTH_PX)


def test_pictures_of_other_sizes_are_told() -> None:
    for color_px, depth_px in (((1000, 1000), DEPTH_PX), (COLOR_PX, (640, 480))):
        with pytest.raises(ValueError, match="pictures of"):
            read_calibration(calibration(), color_px, depth_px)


def test_damage_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[CarpusFault] = []
    path = record(tmp_path / "one.mkv", spoilt=3)
    frames = list(KinectRecording(path, notice=told.append).frames())
    assert [len(frames), [frame.dropped_before for frame in frames]] == [FRAMES - 1, [0, 0, 0, 1, 0]]
    assert [type(fault) for fault in told] == [PicturesLost]
    whole = record(tmp_path / "whole.mkv", told_us=60e6).read_bytes()
    (tmp_path / "half.mkv").write_bytes(whole[: len(whole) * 2 // 3])
    with pytest.raises(RecordingDamaged) as fault:
        list(open_recording(tmp_path / "half.mkv").frames())
    assert "of 60.0 s" in fault.value.detail
    unnamed, unknown = whole.replace(b"COLOR", b"C\xeaLOR"), whole.replace(b"MJPG", b"ZZZZ")
    for content in (b"", b"no Matroska at all", whole[:60], unnamed, unknown):
        (tmp_path / "other.mkv").write_bytes(content)
        with pytest.raises((RecordingDamaged, RecordingUnsupported)):
            open_recording(tmp_path / "other.mkv")
    monkeypatch.setattr(kinect_recording, "find_spec", lambda _: None)
    with pytest.raises(ExtraMissing) as missing:
        open_recording(path)
    assert one_sentence(missing.value).endswith("-m pip install av”.")


def test_large_colour_is_halved_and_the_nearer_reading_wins() -> None:
    depth = Camera(250.0, 250.0, 159.5, 143.5, *DEPTH_PX)
    color = Camera(1000.0, 1000.0, 1023.5, 767.5, 2048, 1536)
    laid = DepthOnColor(depth, color, np.eye(3), np.array([0.05, 0.0, 0.0]), shrink=2).lay(
        square(DEPTH_PX).astype("<u2")
    )
    assert laid.shape == (768, 1024)
    half_fx, edge = 500.0, 189.5 - 159.5
    left = 511.5 + half_fx * (edge / 250.0 + 50.0 / NEAR_MM)
    row = laid[round(383.5 + half_fx * (105 - 143.5) / 250.0)]
    assert np.flatnonzero(row == NEAR_MM)[0] == pytest.approx(left, abs=1.5)
    assert set(np.unique(laid)) == {0, NEAR_MM, FAR_MM}
