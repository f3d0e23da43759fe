"""Which recordings are meant, where the clicks of each are, and where its session goes."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from carpus.app.sources import COLOR_LIST, FILE_SUFFIXES, RECORDING_FILE

CLICKS_FILE = "calibration.json"
"""The clicks of a recording that is a folder; those of ``NAME.oni`` are in ``NAME.calibration.json`` beside it."""
SESSION_SUFFIX = ".h5"


@dataclass(frozen=True, slots=True)
class TrackingInput:
    """One recording (or session, tracked again), its ``clicks`` (None for a session), the ``session`` to be made and
    what that is called in tables: its path in the folder of all."""

    recording: Path
    clicks: Path | None
    session: Path
    name: str


def is_recording(path: Path) -> bool:
    """Whether a path looks like one recording or session, and not like a folder of many."""
    if path.is_dir():
        return (path / COLOR_LIST).exists() or (path / RECORDING_FILE).exists()
    return path.suffix.lower() in (*FILE_SUFFIXES, SESSION_SUFFIX)


def is_many(named: Sequence[Path], output: Path) -> bool:
    """Whether a folder of sessions is asked for, not one session."""
    if len(named) > 1 or output.is_dir():
        return True
    return output.suffix != SESSION_SUFFIX and named[0].is_dir() and not is_recording(named[0])


def recordings_in(folder: Path, left_out: Path) -> Iterator[Path]:
    """Recordings in a folder and the folders in it, in the order of their names, but for the folder ``left_out``.

    Sessions are not among them: they are results, tracked again only where they are named.
    """
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or (path.is_dir() and path.resolve() == left_out.resolve()):
            continue
        if is_recording(path):
            if path.suffix.lower() != SESSION_SUFFIX:
                yield path
        elif path.is_dir():
            yield from recordings_in(path, left_out)


def places(named: Sequence[Path], output: Path) -> list[TrackingInput]:
    """All that is named, folders searched; each once, sessions under ``output`` as the recordings lie to each other.

    What is named and is no folder of recordings counts as one recording, there or not: its fault is told later.
    """
    found: dict[Path, Path] = {}
    base = Path(os.path.commonpath([path.resolve().parent for path in named]))
    for path in named:
        if path.is_dir() and not is_recording(path):
            if len(named) == 1:
                base = path.resolve()
            found |= {each.resolve(): each for each in recordings_in(path, output) if each.resolve() not in found}
        else:
            found.setdefault(path.resolve(), path)
    names = {
        real: real.relative_to(base) if real.is_dir() else real.relative_to(base).with_suffix("") for real in found
    }
    taken = Counter(names.values())
    out = []
    for real, path in found.items():
        name = names[real] if taken[names[real]] == 1 else real.relative_to(base)
        session = name.with_name(name.name + SESSION_SUFFIX)
        out.append(TrackingInput(path.absolute(), clicks_of(path.absolute()), output / session, session.as_posix()))
    return out


def clicks_of(recording: Path) -> Path | None:
    """Where the clicks of a recording are to be; None for a session, which brings its own."""
    if recording.is_dir():
        return recording / CLICKS_FILE
    if recording.suffix.lower() == SESSION_SUFFIX:
        return None
    beside = recording.with_name(f"{recording.stem}.{CLICKS_FILE}")
    return recording.with_name(CLICKS_FILE) if recording.name == RECORDING_FILE and not beside.exists() else beside
