"""Stored sessions for the tests of formats: every value different, and what has to be found again in a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import ExportItem
from carpus.core.formats.export_provenance import build_provenance
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.results.repetition_rows import compute_repetitions
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session
from tests.measures.ways import way
from tests.moments import with_moment
from tests.session.samples import begin_session, compute_time, make_calibration, make_frame, make_header, write_once

FRAMES = 23


def store_session(
    folder: Path, protocol: MarkerProtocol = WRIST6, frames: int = FRAMES, name: str = "one", moving: bool = False
) -> Path:
    """A session of the left hand at 30 frames a second; every fifth frame is lost; it has a repetition and a note.

    ``moving``: all of it tracked, the wrist to and fro.
    """
    return _session(folder / f"{name}.h5", protocol, frames, moving)


@write_once
def _session(path: Path, protocol: MarkerProtocol, frames: int, moving: bool) -> Path:
    exercise = "WRIST_FE" if protocol == WRIST6 else "FIST_COMPOSITE"
    parameters = '{"source": {"name": "clinic-cam-7", "serial": "A00365"}, "settings": {"a": 1}}'
    with begin_session(path, replace(make_header(protocol), exercise=exercise, parameters=parameters)) as writer:
        for row in range(frames):
            frame = make_frame(row, protocol)
            place = np.abs(frame.marker_position_cam_m) * 0.1 + (0.0, 0.0, 0.6)
            if moving:
                angles = np.array([0.05, 0.6, 0.1]) * np.sin(row / 9.0)
                # Facing the camera all the time: a hand that leaves its view has no range of motion.
                turned = with_moment(frame, angles_rad=angles, rotation_w2_w0=facing_camera(protocol))
                frame = replace(turned, status=TrackStatus.TRACKED)
            writer.append(replace(frame, marker_position_cam_m=place, dropped_before=0))
        writer.add_event(compute_time(3), "repetition", "1")
        writer.add_event(compute_time(7), "note", "Mrs Miller, pain")
    return path


def facing_camera(protocol: MarkerProtocol) -> FloatArray:
    return np.asarray(make_calibration(protocol).rotation_w0_cam.T @ np.diag([1.0, -1.0, -1.0]))


def stopping(folder: Path) -> Path:
    """Three repetitions of a wrist that stops for 0.6 s on its way up, 25 + 25 degrees, and comes back at once."""
    folder.mkdir(parents=True, exist_ok=True)
    return _stopping(folder / "stopping.h5")


@write_once
def _stopping(path: Path) -> Path:
    up, hold = way([(25.0, 0.8), (0.0, 0.6), (25.0, 0.8)]), np.ones(30)
    one = np.concatenate((0.0 * hold, up, 50.0 * hold, 50.0 - way([(50.0, 1.0)])))
    angle = np.radians(np.concatenate((np.tile(one, 3), 0.0 * hold)))
    with begin_session(path, replace(make_header(WRIST6), exercise="WRIST_FE")) as writer:
        for row, flexion in enumerate(angle.tolist()):
            frame = with_moment(
                make_frame(row, WRIST6),
                angles_rad=np.array([0.05, flexion, 0.1]),
                angles_sd_rad=np.radians([0.3, 0.2, 0.4]),
                rotation_w2_w0=facing_camera(WRIST6),
            )
            place = np.abs(frame.marker_position_cam_m) * 0.1 + (0.0, 0.0, 0.6)
            measured = (
                frame.marker_measured_px if np.isfinite(frame.marker_measured_px).all() else np.full((6, 2), 99.0)
            )
            writer.append(
                replace(
                    frame, marker_position_cam_m=place, marker_measured_px=measured, dropped_before=0,
                    status=TrackStatus.TRACKED,
                )
            )  # fmt: skip
        writer.add_event(compute_time(7), "note", "stops on the way")
        writer.write_repetitions(compute_repetitions(writer.read_session()))
    return path


def build_take(session: Session, name: str = "one") -> ExportItem:
    return ExportItem(session, compute_session_results(session), name, build_provenance(session))


def wrist_take(folder: Path) -> ExportItem:
    return build_take(read_session(store_session(folder)))


def hand_take(folder: Path) -> ExportItem:
    return build_take(read_session(store_session(folder, HAND21)))
