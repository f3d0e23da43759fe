"""The readers, each in a process that is watched: what it said, how long it took, how much memory it needed."""

from __future__ import annotations

import multiprocessing
import resource
import time
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from tests.torture import mutations

PATIENCE_S = 60.0


@dataclass(frozen=True)
class Outcome:
    """``said`` "read", the name of a fault, or what must not be: an exception's name, ``stuck`` or ``died``."""

    kind: str
    number: int
    said: str
    took_s: float
    memory_bytes: int
    detail: str = ""

    @property
    def good(self) -> bool:
        return self.said == "read" or (self.said[:1].isupper() and not self.said.endswith("!"))


class Reader:
    """One process for many files of a kind; started again when it had to be ended."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._link, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, self.kind), name="torture-reader", daemon=False)
        self._process.start()
        theirs.close()
        assert self._link.poll(120), "a reader does not start"
        self._link.recv()

    def read(self, number: int, path: Path) -> Outcome:
        """Read one file."""
        self._link.send(str(path))
        if not self._link.poll(PATIENCE_S):
            self.end()
            self._start()
            return Outcome(self.kind, number, "stuck!", PATIENCE_S, 0)
        try:
            return Outcome(self.kind, number, *self._link.recv())
        except EOFError:
            self.end()
            self._start()
            return Outcome(self.kind, number, "died!", 0.0, 0)

    def end(self) -> None:
        self._link.close()
        self._process.join(5.0)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()


def read_files(kind: str, count: int, folder: Path) -> list[Outcome]:
    """What came of reading damaged files of a kind."""
    original = mutations.sound(kind, folder / "sound")
    folder = folder / "mutated"
    folder.mkdir(parents=True)
    reader = Reader(kind)
    try:
        reader.read(-1, original)  # what is loaded for the first file is not the file's fault
        return [reader.read(number, mutations.mutate_file(kind, original, number, folder)) for number in range(count)]
    finally:
        reader.end()


def _serve(link: Connection, kind: str) -> None:
    from carpus.core.model.errors import CarpusFault
    from carpus.core.session.reader import READING_PROCESS

    READING_PROCESS.start()
    link.send("ready")
    while True:
        try:
            path = Path(link.recv())
        except EOFError:
            READING_PROCESS.end()
            return
        begin, detail = time.monotonic(), ""
        try:
            _read(kind, path)
            said = "read"
        except CarpusFault as fault:
            said, detail = type(fault).__name__, fault.detail
        except BaseException as cause:
            said, detail = f"{type(cause).__name__}!", str(cause)
        took_s = time.monotonic() - begin
        link.send((said, took_s, _memory_bytes(), detail))


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
        from carpus.core.session.reader import read_detections, read_outline, read_raw, read_session

        outline = read_outline(path)
        session = read_session(path)
        assert len(session) <= max(outline.frames, len(session))
        read_detections(path)
        for _ in read_raw(path):
            pass
    elif kind == "journal":
        from carpus.core.records.recordings import write_session
        from carpus.core.session.reader import verify

        written = write_session(path)
        assert written is None or verify(written).has_checksum
    elif kind == "tum":
        from carpus.app.sources import open_recording

        source = open_recording(path, need_depth=False, leave_out_damaged=True)
        try:
            for frame in source.frames():
                assert frame.color_rgb.shape[2] == 3
        finally:
            source.close()
    elif kind == "clicks":
        from carpus.core.calibration.clicks_file import read_clicks

        read_clicks(path, 640, 480)
    elif kind == "settings":
        from carpus.app.settings import load_valid_settings

        alone = path.parent / f"{path.stem} alone"
        alone.mkdir(exist_ok=True)
        (alone / "settings.toml").write_bytes(path.read_bytes())
        settings, faults = load_valid_settings(alone)
        assert settings.data_folder is not None
        if faults:
            raise faults[0]
    else:
        from carpus.core.records.data_folder import DataFolder
        from carpus.core.records.new_sessions import recover_sessions

        data = path.parent / f"{path.stem} data"
        data.mkdir(exist_ok=True)
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
