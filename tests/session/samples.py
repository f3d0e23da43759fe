"""Made-up sessions: every value different, so that a mix-up of two datasets or rows shows."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from functools import lru_cache, wraps
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from carpus.core.calibration.result import Calibration, CalibrationFinding, Clicks, Verdict
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.model.types import Detections, KinematicState, TrackedFrame, TrackStatus
from carpus.core.session.checks import CHECKSUM_ATTRIBUTE, compute_checksum
from carpus.core.session.file_layout import create_dataset
from carpus.core.session.journal import RecordingJournal
from carpus.core.session.schema import RAW_DEPTH_UNIT, RAW_ENDS, RAW_STREAMS, TableLayout
from carpus.core.session.values import EncodedImages, SessionHeader, new_header
from carpus.core.session.writer import SessionWriter

CAMERA = Camera(570.25, 571.5, 314.0, 235.5, 640, 480, (0.04, -0.12, 0.001, -0.0003, 0.07), origin="file")
SESSION_ID = uuid.UUID("12345678-1234-5678-1234-567812345678")
CREATED = datetime(2026, 11, 13, 15, 30, tzinfo=UTC)


def make_header(
    protocol: MarkerProtocol = WRIST6,
    session_id: uuid.UUID = SESSION_ID,
    dip_free: bool = False,
    subject: str = "Linden 42",
) -> SessionHeader:
    return new_header(
        hand="left",
        protocol=protocol,
        subject_id=subject,
        exercise="wrist flexion",
        parameters='{"profile": "standard"}',
        origin="earlier.h5",
        dip_free=dip_free,
        now=CREATED,
        session_id=session_id,
    )


def make_calibration(protocol: MarkerProtocol = WRIST6) -> Calibration:
    rng = np.random.default_rng(5)
    m = len(protocol.markers)
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    spread = 0.003 * rng.normal(size=(m, 3, 3))
    verdict = Verdict(
        residual_mm=rng.uniform(0.1, 1.0, m),
        hand_length_mm=183.0,
        tilt_deg=12.5,
        distance_m=0.7,
        frames_used=15,
        findings=(CalibrationFinding("swapped", ("MCP2", "MCP3")), CalibrationFinding("tilt", (), 22.0, 15.0, "deg")),
    )
    return Calibration(
        clicks=Clicks("left", protocol, rng.uniform(100, 400, (m, 2)), (True, True, False, True, True)),
        marker_position_w0_m=rng.normal(size=(m, 3)),
        rotation_w0_cam=rotation * np.linalg.det(rotation),  # a turn, no mirror
        translation_w0_cam_m=rng.normal(size=3),
        marker_covariance_w0_m2=spread @ spread.transpose(0, 2, 1),
        start_angles_rad=np.array([0.1, 0.2, 0.3]),
        verdict=verdict,
    )


@lru_cache(maxsize=2000)
def make_frame(row: int, protocol: MarkerProtocol = WRIST6, joints: int | None = None) -> TrackedFrame:
    """Row ``row`` of a session at 30 frames a second; every fifth row is lost, some markers are never measured."""
    rng = np.random.default_rng(row)
    m = len(protocol.markers)
    j = (17 if protocol == HAND21 else 0) if joints is None else joints
    lost = row % 5 == 4
    blank = np.nan if lost else 1.0
    blobs = int(rng.integers(0, 9))
    measured = rng.uniform(0, 480, (m, 2))
    measured[row % m] = np.nan
    return TrackedFrame(
        index=row,
        timestamp_s=compute_time(row),
        status=TrackStatus.LOST if lost else TrackStatus((0, 1, 3)[row % 3]),
        kinematics=KinematicState(
            position_m=blank * rng.normal(size=3),
            velocity_m_s=blank * rng.normal(size=3),
            w0_turn_rad=blank * rng.normal(size=3),
            rotation_w2_w0=blank * np.linalg.qr(rng.normal(size=(3, 3)))[0],
            angular_velocity_rad_s=blank * rng.normal(size=3),
            angles_rad=blank * rng.uniform(-1, 1, 3),
            angles_sd_rad=blank * rng.uniform(0.01, 0.02, 3),
            angles_zyz_rad=np.full(3, np.nan) if row % 3 == 0 else blank * rng.uniform(-1, 1, 3),
            joint_angles_rad=blank * rng.uniform(-1, 1, j),
            joint_angles_sd_rad=blank * rng.uniform(0.01, 0.02, j),
            joint_velocity_rad_s=blank * rng.normal(size=j),
            joint_position_m=blank * rng.normal(size=(m, 3)) if j else np.empty((0, 3)),
        ),
        marker_position_cam_m=blank * rng.normal(size=(m, 3)),
        marker_predicted_px=rng.normal(size=(m, 2)),
        marker_measured_px=measured,
        marker_measured_depth_m=rng.uniform(0.6, 0.9, m),
        detections=Detections(*(rng.uniform(0, 1, shape) for shape in ((blobs, 2), blobs, blobs, blobs, blobs))),
        dropped_before=row % 4,
        measured_share=rng.uniform(0, 1, j or 3),
        nis=float(rng.uniform(0, 20)),
        nis_dof=int(rng.integers(0, 18)),
        doubted=np.arange(m) == row,
    )


def compute_time(row: int) -> float:
    return 1305031102.175304 + row / 30.0


def write_once(write: Callable[..., Path]) -> Callable[..., Path]:
    """What writes a file, and for the same arguments gives a copy of it from then on."""
    contents: dict[Any, bytes] = {}

    @wraps(write)
    def copied(path: Path, *arguments: Any, **named: Any) -> Path:
        kind = (arguments, *named.items())
        if kind in contents:
            path.write_bytes(contents[kind])
        else:
            contents[kind] = write(path, *arguments, **named).read_bytes()
        return path

    return copied


def begin_session(
    path: Path,
    header: SessionHeader | None = None,
    rows: int = 0,
    camera: Camera = CAMERA,
    calibration: Calibration | None = None,
) -> SessionWriter:
    """A session in the making with so many rows."""
    header = header or make_header()
    session = SessionWriter.create(path, header, camera, calibration or make_calibration(header.protocol))
    for row in range(rows):
        session.append(make_frame(row, header.protocol))
    return session


def add_pictures(path: Path, pictures: Sequence[EncodedImages], unit_m: float = 1e-3) -> None:
    """Add the pictures of every row to a finished session, as older programs stored them."""
    with h5py.File(path, "r+") as file:
        layout = TableLayout(WRIST6, ())
        for stream, end in zip(RAW_STREAMS, RAW_ENDS, strict=True):
            contents = [getattr(both, stream.attribute) for both in pictures]
            for field, data in (
                (stream, np.frombuffer(b"".join(contents), np.uint8)), (end, np.cumsum([*map(len, contents)])),
            ):  # fmt: skip
                dataset = create_dataset(file, field, layout)
                dataset.resize(len(data), axis=0)
                dataset[:] = data
        file["/raw"].attrs[RAW_DEPTH_UNIT] = unit_m
        file.attrs[CHECKSUM_ATTRIBUTE] = compute_checksum(file)


def write_closed_journal(path: Path, rows: int) -> None:
    """A journal that nobody adds to any more."""
    write_journal(path, rows).close()


def write_journal(path: Path, rows: int = 0, protocol: MarkerProtocol = WRIST6, **options: Any) -> RecordingJournal:
    """A journal with so many rows that are stored; its clock stands still."""
    header = make_header(protocol, session_id=uuid.uuid4())
    journal = RecordingJournal(path, header, CAMERA, make_calibration(protocol), **{"clock": lambda: 0.0} | options)
    for row in range(rows):
        journal.append(make_frame(row, protocol))
    journal.flush()
    return journal
