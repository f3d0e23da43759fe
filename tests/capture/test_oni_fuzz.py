"""Mutated recordings: whatever a file holds, Carpus survives it, and says so.

``CARPUS_FUZZ_FILES=20000`` runs more of them; the numbers name the files, so any one can be made again.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.files.oni_source import OniSource
from carpus.core.model.errors import CarpusFault
from tests.capture.oni_samples import HEIGHT, WIDTH, records, write_sample
from tests.torture.mutations import cut, flip, noise, remove, repeat, zeros

COUNT = int(os.environ.get("CARPUS_FUZZ_FILES", "160"))
NUMBERS = (0, 1, 2, 27, 29, 255, 65_535, 65_536, 5_760_000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)

Mutation = Callable[[bytearray, np.random.Generator], None]


def structure(data: bytes) -> list[int]:
    """Positions of all bytes that are not a picture's own."""
    places = list(range(24))
    for record in records(data):
        places += range(record.position, record.position + record.fields_size)
    return places


def flip_structure(data: bytearray, rng: np.random.Generator) -> None:
    for place in rng.choice(PLACES, rng.integers(1, 5)):
        data[place] ^= 1 << int(rng.integers(8))


def number_in_structure(data: bytearray, rng: np.random.Generator) -> None:
    place = int(rng.choice(PLACES))
    data[place : place + 4] = int(rng.choice(NUMBERS)).to_bytes(4, "little")


MUTATIONS: tuple[Mutation, ...] = (flip_structure, number_in_structure, flip, noise, zeros, cut, remove, repeat)
PLACES: list[int] = []


def play(number: int, sound: bytes, folder: Path) -> str:
    """Mutate, play to the end, and look at every frame; what became of it."""
    data = bytearray(sound)
    MUTATIONS[number // 2 % len(MUTATIONS)](data, np.random.default_rng(number))
    path = folder / f"mutated {number}.oni"
    path.write_bytes(data)
    try:
        for frame in OniSource(path).frames():
            assert frame.color_rgb.shape == (HEIGHT, WIDTH, 3)
            assert frame.depth_raw is None or frame.depth_raw.shape == (HEIGHT, WIDTH)
    except CarpusFault as fault:
        return type(fault).__name__
    finally:
        path.unlink()
    return "played"


@pytest.mark.timeout(900)
def test_oni_source_mutated_file_raises_only_faults(tmp_path: Path) -> None:
    sound = [
        write_sample(tmp_path / "raw.oni", 4).read_bytes(),
        write_sample(tmp_path / "jpeg.oni", 4, color="jpeg").read_bytes(),
    ]
    outcomes: list[str] = []
    with ThreadPoolExecutor(3) as pool:
        for half, data in enumerate(sound):
            PLACES[:] = structure(data)
            numbers = range(half, COUNT, len(sound))
            outcomes += pool.map(lambda number, data=data: play(number, data, tmp_path), numbers)
    kinds = Counter(outcomes)
    assert sum(kinds.values()) == COUNT
    assert kinds["played"] > COUNT // 10
    assert kinds["RecordingDamaged"] > COUNT // 4
