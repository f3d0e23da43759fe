"""The seal: any change of a finished session shows, whatever was changed, and nothing else makes it show."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from contextlib import suppress
from operator import delitem, setitem
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.errors import SessionChanged, SessionUnreadable
from carpus.core.session import session_file
from carpus.core.session.reader import verify
from carpus.core.session.values import EncodedImages, VerificationResult, stack_states
from carpus.core.session.writer import SessionWriter
from tests.commands import Command
from tests.session.samples import (
    add_pictures,
    begin_session,
    compute_time,
    make_frame,
    write_once,
)

ROWS = 30


def fill_file(path: Path) -> SessionWriter:
    writer = begin_session(path)
    for row in range(ROWS):
        writer.append(make_frame(row))
        if row % 7 == 0:
            writer.add_event(compute_time(row), "note", f"Grüße {row}")
            writer.flush()
    writer.write_motion(stack_states([make_frame(row) for row in range(ROWS)]))
    return writer


@write_once
def store_session(path: Path) -> Path:
    fill_file(path).close()
    add_pictures(path, [EncodedImages(bytes([row]) * 70, b"d" * 30) for row in range(ROWS)])
    return path


CHANGES: dict[str, Callable[[h5py.File], object]] = {
    "an angle": lambda file: setitem(file["/wrist/angles"], (3, 1), file["/wrist/angles"][3, 1] + 1e-9),
    "a name": lambda file: setitem(file.attrs, "subject_id", "Linden 43"),
    "a note": lambda file: setitem(file["/events/text"], 1, "Gruesse"),
    "a unit": lambda file: setitem(file["/wrist/angles"].attrs, "unit", "deg"),
    "a picture": lambda file: setitem(file["/raw/color"], 100, file["/raw/color"][100] ^ 1),
    "a table less": lambda file: delitem(file, "/smoothed"),
    "a table more": lambda file: setitem(file, "/remarks", np.arange(3)),
    "a lens": lambda file: setitem(file["/camera"].attrs, "fx", 571.0),
}


def test_checksum_any_change_is_detected(tmp_path: Path) -> None:
    path = store_session(tmp_path / "s.h5")
    assert verify(path) == VerificationResult(ROWS, has_checksum=True)
    undetected = []
    for name, change in CHANGES.items():
        changed = Path(shutil.copy(path, tmp_path / "changed.h5"))
        with h5py.File(changed, "r+") as file:
            change(file)
        with suppress(SessionChanged):
            session_file.verify(changed)
            undetected.append(name)
    assert undetected == []


def test_checksum_flipped_bits_are_detected(tmp_path: Path) -> None:
    """No single flipped bit in what the values occupy passes: found when they are read, or of a picture by the seal."""
    path = store_session(tmp_path / "s.h5")
    data = path.read_bytes()
    rng = np.random.default_rng(3)
    used = []
    with h5py.File(path, "r") as file:
        for name in ("/wrist/angles", "/frames/timestamp", "/joints/angles", "/smoothed/wrist/angles", "/raw/color"):
            if name in file:
                chunk = file[name].id.get_chunk_info(0)
                places = rng.integers(chunk.byte_offset, chunk.byte_offset + chunk.size, 4).tolist()
                used += [(name, at) for at in places]
    other = tmp_path / "other.h5"
    for name, at in used:
        flipped = bytearray(data)
        flipped[at] ^= 1 << int(rng.integers(8))
        other.write_bytes(flipped)
        with pytest.raises((SessionUnreadable, SessionChanged) if name == "/raw/color" else SessionUnreadable):
            (session_file.verify if name == "/raw/color" else session_file.read_session)(other)
    assert len(used) == 16


def test_verify_command_reports_changes(tmp_path: Path, command: Command) -> None:
    path = store_session(tmp_path / "s.h5")
    good = command("verify", path)
    assert (good.code, good.err, "Complete and unchanged" in good.out) == (0, "", True)
    with h5py.File(path, "r+") as file:
        CHANGES["an angle"](file)
    bad = command("verify", path)
    assert (bad.code, bad.out, bad.err.count("\n")) == (1, "", 1)
    assert bad.err.startswith("carpus: This session was modified after it was completed")
