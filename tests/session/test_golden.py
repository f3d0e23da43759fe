"""Files as every version wrote them, kept: what an old Carpus stored, this one reads, value by value.

A new format version adds its own files here, written by the program of that version; those that are here never change.
"""

from __future__ import annotations

import lzma
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.session import schema
from carpus.core.session.reader import has_raw, raw_depth_unit_m, read_detections, read_raw, read_session, verify
from carpus.core.session.values import EncodedImages
from tests.session.samples import CAMERA, compute_time

GOLDEN = Path(__file__).parent / "golden"
ROWS = 12


def unpack_golden(name: str, folder: Path) -> Path:
    path = folder / name
    path.write_bytes(lzma.decompress((GOLDEN / f"{name}.xz").read_bytes()))
    return path


@pytest.mark.parametrize("version", range(1, schema.FORMAT_VERSION + 1))
@pytest.mark.parametrize("protocol", [WRIST6, HAND21], ids=lambda protocol: protocol.name)
def test_golden_old_session_is_read(tmp_path: Path, version: int, protocol: MarkerProtocol) -> None:
    path = unpack_golden(f"v{version}-{protocol.name}.h5", tmp_path)
    before = path.read_bytes()
    session = read_session(path)
    assert (len(session), session.header.protocol) == (ROWS, protocol)
    assert session.timestamp_s.tolist() == [compute_time(row) for row in range(ROWS)]
    assert (session.header.subject_id, session.header.hand) == ("Linden 42", "left")
    assert session.header.recording_id
    assert session.header.created.startswith("2026-11-13T15:30")
    assert session.camera == CAMERA
    assert [event.text for event in session.events] == ["Grüße"]
    table, pictures = read_detections(path), list(read_raw(path))
    with h5py.File(path, "r") as file:  # read by the library alone, by the paths of that version
        stored = {
            "/frames/status": session.status,
            "/smoothed/wrist/angles": session.smoothed.angles_rad,
            "/markers/position_camera": session.markers.position_cam_m,
            "/markers/measured": session.markers.measured_px,
            "/quality/dropped_frames": session.quality.dropped_before,
            "/quality/nis": session.quality.nis,
            "/calibration/clicks": session.calibration.clicks.pixel,
            "/calibration/marker_position": session.calibration.marker_position_w0_m,
            "/calibration/rotation": session.calibration.rotation_w0_cam,
            "/calibration/translation": session.calibration.translation_w0_cam_m,
            "/detections/frame": table.frame,
            "/detections/pixel": table.blobs.pixel,
            "/detections/depth_sd": table.blobs.depth_sd_m,
        }
        motion = [field for field in schema.MOTION_FIELDS if field.path in file]
        assert len(motion) >= (11 if protocol is HAND21 else 7)
        stored |= {field.path: getattr(session.motion, field.attribute) for field in motion}
        for place, values in stored.items():
            assert file[place].shape[0] > 0
            np.testing.assert_array_equal(values, file[place][()], err_msg=place)
        assert np.isfinite(file["/wrist/angles"][0]).all()
        h5_unit = file["/raw"].attrs["depth_unit_m"]
    assert pictures == [EncodedImages(bytes([row]) * 20, b"d" * row) for row in range(ROWS)]
    assert has_raw(path)
    assert raw_depth_unit_m(path) == h5_unit
    assert verify(path).has_checksum == (version > 1)
    assert path.read_bytes() == before


def test_golden_surface_samples_are_read(tmp_path: Path) -> None:
    """A session of version 2 with ``/surface``, which the first of that version did not have."""
    table = read_detections(unpack_golden("v2-surface.h5", tmp_path))
    for row in range(ROWS):
        count = row % 4 * 3
        blobs, steps = table.get_frame(row), np.arange(count)
        for kept, u, v, depth_m in (
            (blobs.surface, 100.0 + row + steps, 200.0 + 2 * steps, 0.6),
            (blobs.fingers, 300.0 + row + steps, 50.0 + steps, 0.7),
        ):
            if not count:
                assert kept is None or not len(kept.depth_m)
                continue
            np.testing.assert_array_equal(kept.pixel, np.column_stack([u, v]))
            np.testing.assert_allclose(kept.depth_m, depth_m + 0.001 * row + 0.0001 * steps, atol=1e-7)
