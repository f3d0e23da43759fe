"""``truth.h5``: the true values as a session file, so that everything that reads a session reads them too."""

from __future__ import annotations

import math
import uuid
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.hand.clinical_angles import zyz_from_rotation
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.truth import Truth
from carpus.core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

SEEN_SHARE = 0.35
"""A disc of which less than this can be seen counts as not measured."""
VISIBLE_SHARE_PATH = "/simulation/visible_share"
_PALM_NEEDED = 3


def write_truth(path: Path, truth: Truth, clicks: Clicks, software_version: str) -> None:
    """Write the true values; ``parameters`` is the JSON of the spec, standard deviations are zero, and measured
    is what the camera can see of the discs. The same truth gives the same file, byte for byte."""
    spec = truth.spec
    header = new_header(
        hand=spec.hand,
        protocol=spec.marker_protocol,
        software_version=software_version,
        exercise=spec.motion,
        parameters=spec.to_json(),
        dip_free=spec.dip == "free",
        now=datetime.fromtimestamp(float(truth.timestamp_s[0]), UTC),
        session_id=uuid.uuid5(uuid.NAMESPACE_OID, spec.to_json()),
    )
    with SessionWriter.create(path, header, truth.camera, _calibration(truth, clicks)) as writer:
        for i in range(len(truth.timestamp_s)):
            writer.append(_tracked(truth, i))
    with h5py.File(path, "r+") as file:
        dataset = file.create_dataset(VISIBLE_SHARE_PATH, data=truth.visible_share)
        dataset.attrs["unit"] = "1"
        dataset.attrs["description"] = "share of each disc's paper that the camera sees"
        dataset.attrs["names"] = list(spec.marker_protocol.markers)


def read_visible_share(path: Path) -> FloatArray:
    """(N, M) as stored by :func:`write_truth`."""
    with h5py.File(path, "r") as file:
        return np.asarray(file[VISIBLE_SHARE_PATH][()], dtype=np.float64)


def _calibration(truth: Truth, clicks: Clicks) -> Calibration:
    normal = truth.rotation_w0_cam[:, 2]
    verdict = Verdict(
        residual_mm=np.zeros(len(truth.marker_position_w0_m)),
        hand_length_mm=float("nan"),
        tilt_deg=math.degrees(math.acos(min(1.0, abs(float(normal[2]))))),
        distance_m=float(truth.translation_w0_cam_m[2]),
        frames_used=1,
        findings=(),
    )
    return Calibration(
        clicks=clicks,
        marker_position_w0_m=truth.marker_position_w0_m,
        rotation_w0_cam=truth.rotation_w0_cam,
        translation_w0_cam_m=truth.translation_w0_cam_m,
        marker_covariance_w0_m2=np.zeros((len(truth.marker_position_w0_m), 3, 3)),
        start_angles_rad=np.zeros(3),
        verdict=verdict,
    )


def _tracked(truth: Truth, i: int) -> TrackedFrame:
    spec = truth.spec
    joints = truth.joint_angles_rad.shape[1]
    visible = truth.visible_share[i] > SEEN_SHARE
    pixel = np.where(visible[:, None], truth.disc_pixel[i], np.nan)
    depth = np.where(visible, truth.disc_position_cam_m[i, :, 2], np.nan)
    palm_seen = int(visible[list(spec.marker_protocol.palm)].sum())
    return TrackedFrame(
        index=i,
        timestamp_s=float(truth.timestamp_s[i]),
        status=TrackStatus.TRACKED if palm_seen >= _PALM_NEEDED else TrackStatus.PREDICTED,
        moment=Moment(
            position_m=truth.position_m[i],
            velocity_m_s=truth.velocity_m_s[i],
            w0_turn_rad=np.zeros(3),
            rotation_w2_w0=truth.rotation_w2_w0[i],
            angular_velocity_rad_s=truth.angular_velocity_rad_s[i],
            angles_rad=truth.angles_rad[i],
            angles_sd_rad=np.zeros(3),
            angles_zyz_rad=zyz_from_rotation(truth.rotation_w2_w0[i]),
            joint_angles_rad=truth.joint_angles_rad[i],
            joint_angles_sd_rad=np.zeros(joints),
            joint_velocity_rad_s=truth.joint_velocity_rad_s[i],
            joint_position_m=truth.joint_position_w0_m[i],
        ),
        marker_position_cam_m=truth.disc_position_cam_m[i],
        marker_predicted_px=truth.disc_pixel[i],
        marker_predicted_cov_px2=np.zeros((len(visible), 2, 2)),
        marker_measured_px=pixel,
        marker_measured_depth_m=depth,
        detections=Detections.none(),
        dropped_before=int(truth.dropped_before[i]),
        measured_share=np.full(joints or 3, np.nan),
        nis=float("nan"),
        nis_dof=0,
    )
