"""Damaged files of every kind Carpus reads: by bytes, by numbers and words, and by structure."""

from __future__ import annotations

import json
import os
import re
import shutil
import sqlite3
import uuid
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np

from carpus.core.calibration.clicks_file import Clicks, write_clicks
from carpus.core.capture.files.tum import TumWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Frame
from carpus.core.records.database import STORE_FILE
from carpus.core.session.values import EncodedImages
from tests.capture.oni_samples import CAMERA as SMALL
from tests.capture.oni_samples import color_picture, depth_picture
from tests.records.samples import LINDEN, T0, measure, open_store
from tests.session.samples import (
    add_pictures,
    begin_session,
    compute_time,
    make_frame,
    make_header,
    write_journal,
)
from tests.session.test_golden import unpack_golden

KINDS = ("session", "part", "tum", "clicks", "settings", "register", "journal")
NUMBERS = (0, 1, 2, 255, 65_535, 65_536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 1 << 40, 1 << 63, (1 << 64) - 1)
WORDS = (
    "nan", "inf", "-1", "1e999", "9" * 400, "../../../etc/passwd", "/dev/zero", "\\u0000", "[" * 300, "=1+1", " ", "",
)  # fmt: skip


def sound(kind: str, folder: Path) -> Path:
    """A sound file or folder of a kind."""
    folder.mkdir(parents=True, exist_ok=True)
    info = SourceInfo("sample", SMALL, True, None, 30.0)
    frames = [Frame(n, n / 30.0, color_picture(n), depth_picture(n), 1e-3) for n in range(6)]
    if kind == "part":
        return unpack_golden("v2-wrist6.h5.0123abcd.part", folder)
    if kind == "journal":
        journal = write_journal(folder / "s.journal", 30)
        for row in range(30, 60):
            journal.append(make_frame(row))
            if row % 6 == 0:
                journal.add_event(compute_time(row), "note", "a note")
                journal.flush()
        journal.close()
        return journal.path
    if kind == "session":
        with begin_session(folder / "s.h5", make_header(session_id=uuid.UUID(int=77)), 30) as writer:
            writer.add_event(compute_time(3), "note", "a note")
        add_pictures(writer.path, [EncodedImages(b"c" * 90, b"d" * 30)] * 30)
        return writer.path
    if kind == "tum":
        with TumWriter(folder / "tum", info) as tum:
            for frame in frames:
                tum.append_frame(frame)
        return folder / "tum"
    if kind == "clicks":
        write_clicks(folder / "clicks.json", Clicks("left", WRIST6, np.arange(12.0).reshape(6, 2)))
        return folder / "clicks.json"
    if kind == "settings":
        lines = ("[screen]", 'theme = "dark"', "text_scale = 1.25", "[recording]", 'folder = ""', "smooth = true")
        (folder / "settings.toml").write_text("\n".join((*lines, "[live]", "max_waiting_rows = 900", "")))
        return folder / "settings.toml"
    with open_store(folder / "data") as house:
        measure(house, house.patients.add(LINDEN), T0)
    return folder / "data" / STORE_FILE


def mutate_file(kind: str, original: Path, number: int, folder: Path) -> Path:
    """The ``number``-th damaged copy; the same number gives the same damage."""
    rng = np.random.default_rng([KINDS.index(kind), number])
    target = folder / f"{number}{''.join(original.suffixes) or ''}"
    if kind == "tum":
        shutil.copytree(original, target)
        files = sorted(path for path in target.rglob("*") if path.is_file())
        lists = [path for path in files if path.suffix in (".txt", ".yaml")]
        _damage(rng.choice(lists if rng.random() < 0.7 else files), rng)  # type: ignore[arg-type]
        return target
    if kind == "part":
        target = folder / f"{number}.h5.{number:08x}.part"
    shutil.copy(original, target)
    if kind in ("session", "part") and number % 2:
        _structure(target, rng)
    elif kind == "register" and number % 2:
        _rows(target, rng)
    else:
        _damage(target, rng)
    if kind in ("session", "part"):
        _make_sparse(target)
    if kind == "part":
        os.utime(target, (0, 0))
    return target


def _make_sparse(path: Path, block: int = 1 << 16) -> None:
    """Room that a session only keeps for itself takes none in thousands of copies."""
    data = path.read_bytes()
    with path.open("wb") as file:
        for start in range(0, len(data), block):
            part = data[start : start + block]
            if part.strip(b"\0"):
                file.seek(start)
                file.write(part)
        file.truncate(len(data))


def _damage(path: Path, rng: np.random.Generator) -> None:
    data = bytearray(path.read_bytes())
    if not data:
        return
    text = path.suffix in (".txt", ".yaml", ".json", ".toml")
    change = rng.choice(TEXT_CHANGES if text and rng.random() < 0.6 else BYTE_CHANGES)  # type: ignore[arg-type]
    change(data, rng)
    path.write_bytes(data)


def flip(data: bytearray, rng: np.random.Generator) -> None:
    for place in rng.integers(0, len(data), rng.integers(1, 30)):
        data[place] ^= 1 << int(rng.integers(8))


def _early(data: bytearray, rng: np.random.Generator) -> None:
    """Where headers and indexes are."""
    for place in rng.integers(0, min(len(data), 20_000), rng.integers(1, 8)):
        data[place] = int(rng.integers(256))


def _number(data: bytearray, rng: np.random.Generator) -> None:
    size = int(rng.choice((2, 4, 8)))
    place = int(rng.integers(0, max(1, min(len(data), 40_000) - size)))
    data[place : place + size] = (int(NUMBERS[rng.integers(len(NUMBERS))]) % (1 << 8 * size)).to_bytes(size, "little")


def _swap(data: bytearray, rng: np.random.Generator) -> None:
    """Two blocks exchanged: what makes an index point at itself."""
    size = int(rng.choice((64, 512, 1024, 4096)))
    if len(data) < 3 * size:
        return
    a, b = (int(place) // 8 * 8 for place in rng.integers(0, len(data) - size, 2))
    data[a : a + size], data[b : b + size] = data[b : b + size], data[a : a + size]


def _pointer(data: bytearray, rng: np.random.Generator) -> None:
    """An address in the file exchanged for another one."""
    place = int(rng.integers(0, max(1, min(len(data), 40_000) - 8))) // 8 * 8
    data[place : place + 8] = int(rng.integers(0, len(data))).to_bytes(8, "little")


def noise(data: bytearray, rng: np.random.Generator) -> None:
    start = int(rng.integers(0, len(data)))
    size = min(int(rng.integers(1, 4000)), len(data) - start)
    data[start : start + size] = rng.integers(0, 256, size).astype(np.uint8).tobytes()


def zeros(data: bytearray, rng: np.random.Generator) -> None:
    start = int(rng.integers(0, len(data)))
    size = min(int(rng.integers(1, 4000)), len(data) - start)
    data[start : start + size] = bytes(size)


def cut(data: bytearray, rng: np.random.Generator) -> None:
    del data[int(rng.integers(0, len(data))) :]


def remove(data: bytearray, rng: np.random.Generator) -> None:
    start = int(rng.integers(0, len(data)))
    del data[start : start + int(rng.integers(1, 200))]


def repeat(data: bytearray, rng: np.random.Generator) -> None:
    start = int(rng.integers(0, len(data)))
    data[start:start] = data[start : start + int(rng.integers(1, 2000))]


def _word(data: bytearray, rng: np.random.Generator) -> None:
    """A number or a word of a text exchanged."""
    found = list(re.finditer(rb"[-+.\w]+", bytes(data)))
    if found:
        one = found[int(rng.integers(len(found)))]
        data[one.start() : one.end()] = WORDS[int(rng.integers(len(WORDS)))].encode()


def _line(data: bytearray, rng: np.random.Generator) -> None:
    lines = bytes(data).split(b"\n")
    one, other = (int(number) for number in rng.integers(0, len(lines), 2))
    lines[one] = lines[other] if rng.random() < 0.5 else b""
    data[:] = b"\n".join(lines)


BYTE_CHANGES = (
    flip, _early, _early, _number, _number, _swap, _swap, _pointer, _pointer, noise, zeros, cut, remove, repeat,
)  # fmt: skip
TEXT_CHANGES = (_word, _word, _line)


def _structure(path: Path, rng: np.random.Generator) -> None:
    """Another thing in the place of a dataset, a value or an attribute, by way of the library."""
    with h5py.File(path, "r+") as file:
        places: list[str] = []
        file.visit(places.append)
        place = "/" + places[int(rng.integers(len(places)))]
        kind = int(rng.integers(len(INSTEAD) + 5))
        if kind < len(INSTEAD):
            del file[place]
            INSTEAD[kind](file, place, rng)
        elif kind < len(INSTEAD) + 2:
            _values(file[place], rng)
        else:
            _attribute(file if rng.random() < 0.7 else file[place], rng)


def _huge(file: h5py.File, place: str, rng: np.random.Generator) -> None:
    file.create_dataset(place, (1 << int(rng.integers(20, 50)), 3), "f8", maxshape=(None, 3), chunks=(1024, 3))


def _other_type(file: h5py.File, place: str, rng: np.random.Generator) -> None:
    file[place] = np.zeros((30, 3), ("i1", "f2", "S5", "c16", "?")[int(rng.integers(5))])


def _external(file: h5py.File, place: str, _: np.random.Generator) -> None:
    file.create_dataset(place, (30, 3), "f8", external=[("/etc/passwd", 0, 720)])


def _loop(file: h5py.File, place: str, _: np.random.Generator) -> None:
    file[place] = file["/"]


def _values(thing: h5py.Dataset | h5py.Group, rng: np.random.Generator) -> None:
    if isinstance(thing, h5py.Dataset) and thing.dtype.kind in "fiu" and thing.size:
        value = (np.inf, np.nan, -1.0, 1e300, 2.0**31)[int(rng.integers(5))]
        with np.errstate(invalid="ignore"):
            thing[int(rng.integers(thing.shape[0]))] = np.float64(value).astype(thing.dtype)


def _attribute(thing: h5py.Dataset | h5py.Group, rng: np.random.Generator) -> None:
    names = list(thing.attrs)
    if names:
        values = ("", " ", "\n", -1, np.nan, 1 << 62, "x" * 60_000, "[" * 5000, np.zeros(100), json.dumps({"a": 1}))
        thing.attrs[names[int(rng.integers(len(names)))]] = values[int(rng.integers(len(values)))]


INSTEAD: tuple[Callable[[h5py.File, str, np.random.Generator], object], ...] = (
    lambda *_: None,
    lambda file, place, _: file.create_group(place),
    lambda file, place, _: file.create_dataset(place, data=1.0),
    lambda file, place, _: file.__setitem__(place, h5py.ExternalLink("/dev/zero", place)),
    _huge, _other_type, _external, _loop,
)  # fmt: skip
"""What is put where something was."""


def _rows(path: Path, rng: np.random.Generator) -> None:
    """Rows that no program wrote."""
    table = ("patient", "session", "seen")[int(rng.integers(3))]
    database = sqlite3.connect(path)
    try:
        columns = [row[1] for row in database.execute(f"PRAGMA table_info({table})")]
        column = columns[int(rng.integers(len(columns)))]
        values = (None, "", " ", -1, 1 << 62, 1e308, b"\xff\x00", "x" * 9000, "../../x", "1e999")
        database.execute("PRAGMA writable_schema = ON")
        try:
            if rng.random() < 0.15:
                database.execute(f"DROP TABLE {table}")
            elif rng.random() < 0.1:
                database.execute(f"PRAGMA user_version = {int(rng.integers(0, 12))}")
            else:
                database.execute(f"UPDATE {table} SET {column} = ?", (values[int(rng.integers(len(values)))],))
            database.commit()
        except sqlite3.Error:
            database.rollback()
    finally:
        database.close()
