"""A data folder with patients and sessions, and a look for traces in it."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from carpus.core.hand.protocols import WRIST6
from carpus.core.session.register import PatientEntry, PatientRegister
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from tests.session.samples import CAMERA, make_calibration, make_frame

T0 = datetime(2026, 10, 9, 9, 51, tzinfo=UTC)
LINDEN = PatientEntry("Linden 42", "right", "left", note="flexor tendon", name="Erika Mustermann")
HERON = PatientEntry("Heron 17", "left", name="Otto Normal")


def measure(register: PatientRegister, patient_id: str, when: datetime, recording_id: str = "") -> str:
    """One session of a patient with all that may lie beside it; its identity."""
    pseudonym = register.patient(patient_id).entry.pseudonym
    path = register.new_session_path(patient_id, "WRIST_FE", "right", when)
    header = new_header(
        hand="right",
        protocol=WRIST6,
        software_version="0",
        subject_id=pseudonym,
        exercise="WRIST_FE",
        now=when,
        recorded=when.isoformat(),
        recording_id=recording_id,
    )
    with SessionWriter.create(path, header, CAMERA, make_calibration()) as writer:
        for row in range(4):
            writer.append(make_frame(row))
    path.with_suffix(".carpusraw").write_bytes(b"pictures of " + pseudonym.encode())
    path.with_suffix(".markers.jpg").write_bytes(b"photo")
    path.with_suffix(".choices.json").write_text("{}")
    return register.enter_session(path, patient_id).session_id


def traces(folder: Path, *words: str) -> list[str]:
    """Files whose name or content holds one of the words."""
    found = []
    for path in sorted(folder.rglob("*")):
        content = path.read_bytes() if path.is_file() else b""
        if any(word.encode() in content or word in path.name for word in words):
            found.append(path.name)
    return found
