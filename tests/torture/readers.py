"""What comes of reading damaged files, in a process whose end, time and memory are watched."""

from __future__ import annotations

import multiprocessing
import resource
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from carpus.app.settings import load_valid_settings
from carpus.app.sources import open_recording
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.model.errors import CarpusFault
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.records.recordings import write_session
from carpus.core.session.reader import read_detections, read_outline, read_raw, read_session, verify
from tests.torture import mutations


@dataclass(frozen=True)
class Outcome:
    """``said``: "read", or the name of a fault."""

    kind: str
    said: str
    took_s: float


def read_files(kinds: Sequence[str], count: int, folder: Path) -> tuple[list[Outcome], int]:
    """What came of reading so many damaged files of each kind, and the most memory that this needed, in bytes.

    Raises AssertionError for whatever is not a fault.
    """
    outcomes = []
    for kind in kinds:
        original = mutations.sound(kind, folder / kind / "sound")
        mutated = folder / kind / "mutated"
        mutated.mkdir()
        for number in range(count):
            path = mutations.mutate_file(kind, original, number, mutated)
            begin_s = time.monotonic()
            try:
                _read(kind, path)
                said = "read"
            except CarpusFault as fault:
                said = type(fault).__name__
            except Exception as cause:
                raise AssertionError(f"{kind} {number}: {type(cause).__name__}: {cause}") from cause
            outcomes.append(Outcome(kind, said, time.monotonic() - begin_s))
    return outcomes, _memory_bytes()


def _memory_bytes() -> int:
    """The most that this process and its children ever held; of the reading process what it holds now at most."""
    # Not ``ru_maxrss`` of itself: that begins with what the process was that started this one.
    children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    running = (_most_held_kb(child.pid) for child in multiprocessing.active_children())
    return 1024 * max(_most_held_kb("self"), children, *running, 0)


def _most_held_kb(process: object) -> int:
    with suppress(OSError):
        for line in Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith("VmHWM"):
                return int(line.split()[1])
    return 0


def _read(kind: str, path: Path) -> None:
    if kind in ("session", "part"):
        outline, session = read_outline(path), read_session(path)
        assert len(session) == outline.frames
        read_detections(path)
        for _ in read_raw(path):
            pass
    elif kind == "journal":
        written = write_session(path)
        assert written is None or verify(written).has_checksum
    elif kind == "tum":
        source = open_recording(path, need_depth=False, leave_out_damaged=True)
        try:
            for frame in source.frames():
                assert frame.color_rgb.shape[2] == 3
        finally:
            source.close()
    elif kind == "clicks":
        read_clicks(path, 640, 480)
    elif kind == "settings":
        alone = path.parent / f"{path.stem} alone"
        alone.mkdir()
        (alone / "settings.toml").write_bytes(path.read_bytes())
        settings, faults = load_valid_settings(alone)
        assert settings.data_folder is not None
        if faults:
            raise faults[0]
    else:
        data = path.parent / f"{path.stem} data"
        data.mkdir()
        (data / "records.sqlite3").write_bytes(path.read_bytes())
        library = DataFolder(data)
        try:
            if library.store.startup_faults:
                raise library.store.startup_faults[0]
            recover_sessions(library)
            for record in library.patients.search():
                library.session_list.patient_sessions(record.patient_id)
        finally:
            library.close()
