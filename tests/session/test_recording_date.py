"""When the hand moved, and which recording it was: told by the file, whoever tracks it, however often."""

from __future__ import annotations

import uuid
from datetime import UTC, datetime, timedelta
from pathlib import Path

from carpus.core.model.dates import moment_from_timestamp, to_iso
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.records.values import Patient, select_latest_versions
from carpus.core.session.values import new_header
from tests.records.samples import open_store
from tests.session.samples import begin_session

MOVED = datetime(2023, 4, 5, 14, 30, tzinfo=UTC)
TRACKED = datetime(2026, 11, 22, 9, 0, tzinfo=UTC)


def write(path: Path, tracked: datetime = TRACKED, recorded: datetime = MOVED, recording: str = "") -> Path:
    header = new_header(
        hand="right",
        protocol=WRIST6,
        subject_id="Linden 42",
        exercise="WRIST_FE",
        now=tracked,
        recorded=recorded.isoformat(),
        recording_id=recording,
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    begin_session(path, header, 4).close()
    return path


def test_recording_date_ignores_camera_clock() -> None:
    assert moment_from_timestamp(12.25) is None
    assert moment_from_timestamp(float("nan")) is None
    assert moment_from_timestamp(datetime.now(UTC).timestamp() + 7 * 86400.0) is None
    assert moment_from_timestamp(MOVED.timestamp()) == MOVED
    assert datetime.fromisoformat(to_iso(MOVED)) == MOVED


def test_recording_counts_once_by_newest_result(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        patient = house.patients.add(Patient("Linden 42", "right"))
        recording = str(uuid.uuid4())
        folder = house.store.sessions_folder / "Linden-42"
        for number, tracked in enumerate((TRACKED, TRACKED + timedelta(days=9), TRACKED + timedelta(days=2))):
            house.index.add(write(folder / f"{number}.h5", tracked, recording=recording), patient)
        other = write(folder / "other.h5", TRACKED - timedelta(days=400), MOVED + timedelta(days=7))
        house.index.add(other, patient)
        record = house.patients.get(patient)
        assert (record.session_count, record.result_count) == (2, 4)
        assert record.last_session == MOVED + timedelta(days=7), "the last movement, not the last tracking"
        kept = select_latest_versions(house.index.patient_sessions(patient))
        assert [entry.path.name for entry in kept] == ["other.h5", "1.h5"]
        assert [entry.recorded for entry in kept] == [MOVED + timedelta(days=7), MOVED]
        house.files.scan()
        assert house.patients.get(patient).session_count == 2
