"""A session written anew for another patient: all that it says stays, but not a byte of the former name."""

from __future__ import annotations

import os
from pathlib import Path

import h5py

from carpus.core.durable import write_fault
from carpus.core.session.disk import part_path, publish
from carpus.core.session.new_file import new_file
from carpus.core.session.opened import open_session, verify
from carpus.core.session.seal import ATTRIBUTE, seal_of


def given(path: Path, target: Path, subject_id: str) -> None:
    """Write it as ``target``. Runs in the reading process. Raises :class:`SessionUnreadable`, :class:`SessionChanged`
    for one that is not whole, and the faults of writing; then nothing is left behind."""
    verify(path)
    with open_session(path) as old:
        part = part_path(target, str(old.attrs["session_id"]))
        try:
            with new_file(part) as file:
                _copy(old, file, subject_id)
            with part.open("rb") as written:
                os.fsync(written.fileno())
            verify(part)
            publish(part, target)
        except (OSError, RuntimeError) as cause:
            raise write_fault(target, cause) from cause
        finally:
            part.unlink(missing_ok=True)


def _copy(old: h5py.File, file: h5py.File, subject_id: str) -> None:
    for name in old:
        old.copy(name, file)
    for name, value in old.attrs.items():
        if name != ATTRIBUTE:
            file.attrs[name] = subject_id if name == "subject_id" else value
    if ATTRIBUTE in old.attrs:
        file.attrs[ATTRIBUTE] = seal_of(file)
