"""The W0 that a session stores is the one its places and turns are in: read back by plain h5py."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.pipeline.track import TrackSettings, track_recording
from carpus.core.simulation.recording import CLICKS_FILE
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import SoftTissue
from tests.rendered import LEFT_DEVIATION, WHOLE_HAND, Rendered

# Discs that glide over the bones leave the axis of W2 by what they glided: only on stiff skin does the axis run through
# them, which is what shows that it was stored in the axes that the file says.
STIFF = TrackSettings(
    smooth=False,
    tracker=TrackerSettings(
        tissue=SoftTissue(
            **{f"{place}_{way}_m": 1e-7 for place in ("knuckle", "wrist") for way in ("along", "across", "up")}
        )
    ),
)


@pytest.mark.parametrize(
    ("spec", "start_deg"),
    [(LEFT_DEVIATION, (4.0, -20.0, 8.0)), (WHOLE_HAND, (0.0, 0.0, 0.0))],
    ids=["started bent", "hand"],
)
def test_stored_w0_pose_maps_wrist_to_its_marker(
    spec: RecordingSpec, start_deg: tuple[float, ...], rendered: Rendered, tmp_path: Path
) -> None:
    recording = rendered(spec)
    clicks = read_clicks(recording / CLICKS_FILE, 640, 480)
    source = TumFolder(recording)
    start = np.radians(start_deg)
    track_recording(source, clicks, tmp_path / "s.h5", STIFF, start_angles_rad=start)
    source.close()
    with h5py.File(tmp_path / "s.h5") as file:
        to_cam, origin = file["calibration/rotation"][()], file["calibration/translation"][()]
        position, turn = file["wrist/position"][()], file["wrist/w0_turn"][()]
        rotation = file["wrist/rotation"][()]
        discs = file["markers/position_camera"][()]
        at = list(file["markers"].attrs["names"]).index
        joints = file["joints/position"][()] if spec is WHOLE_HAND else None
    missed_m = np.linalg.norm(position @ to_cam.T + origin - discs[:, at("WRIST")], axis=1)
    assert missed_m.max() < 1e-6
    x_axis = (to_cam @ Rotation.from_rotvec(turn).as_matrix() @ rotation)[:, :, 0]
    towards = discs[:, at("MCP3")] - discs[:, at("WRIST")]
    towards /= np.linalg.norm(towards, axis=1)[:, None]
    assert np.degrees(np.linalg.norm(np.cross(x_axis, towards), axis=1)).max() < 0.01
    if not any(start_deg):
        assert np.degrees(np.abs(turn)).max() > 0.01, "the palm was refined, or nothing is shown here"
    if joints is not None:
        # The joints of the palm lie under their discs, wherever the hand has turned.
        under = discs[:, at("MCP3")] - (joints[:, at("MCP3")] @ to_cam.T + origin)
        in_hand = np.einsum("nji,nj->ni", to_cam @ Rotation.from_rotvec(turn).as_matrix() @ rotation, under)
        assert np.ptp(in_hand, axis=0).max() < 1e-3
        assert in_hand[:, 2].min() > 0.005, "under the skin"
