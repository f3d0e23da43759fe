"""Other people's filters and MediaPipe Hands beside one tracked frame of Carpus: ``whole-hand --compare``.

Every peer runs in an environment of its own, made when it is first asked for, since one pins what the other has
outgrown. All figures are ratios to the plain filter, which is stepped beside each peer in the same process.
"""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
import venv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import platformdirs

from carpus.core.model.hand.protocols import HAND21
from carpus.core.simulation.render import Renderer
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.sensor import ColorSensor
from tests.bench.timing import line
from tests.bench.whole_hand import FINGERS

HEAD = (
    "| peer | CPU ms, median | p95 | times the plain step | Carpus, whole frame, is | note |\n|---|---|---|---|---|---|"
)
NEEDS = {"filters": ("stonesoup==1.9.1", "filterpy==1.4.5"), "mediapipe": ("mediapipe==0.10.21",)}
"""0.10.21 is the last MediaPipe that brings its models along."""
PICTURES = 40
_ROOT = Path(__file__).resolve().parents[2]


class PeerMissingError(Exception):
    """A peer could not be installed or run; the message is for the table."""


def _folder() -> Path:
    return Path(platformdirs.user_cache_dir("carpus", appauthor=False)) / "bench"


def _environment(which: str) -> Path:
    """Python of the environment of one peer, made if it is not there."""
    place = _folder() / f"{which}-py{sys.version_info.major}{sys.version_info.minor}"
    python = place / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    ready = place / "ready.txt"
    wanted = " ".join(NEEDS[which])
    if ready.exists() and ready.read_text(encoding="utf-8") == wanted:
        return python
    print(f"Installing {wanted} in an environment of its own", file=sys.stderr)
    venv.create(place, with_pip=True, clear=True)
    done = subprocess.run(
        [python, "-m", "pip", "install", "-q", *NEEDS[which]], capture_output=True, text=True, check=False
    )
    if done.returncode:
        reason = [text for text in done.stderr.splitlines() if text.startswith("ERROR")] or [""]
        raise PeerMissingError(f"{wanted} could not be installed here: {reason[-1].removeprefix('ERROR: ')}")
    ready.write_text(wanted, encoding="utf-8")
    return python


def _plain_hand() -> Path:
    """Pictures of the simulated hand without any disc: MediaPipe does not see a marked hand."""
    target = _folder() / "plain-hand.npz"
    if not target.exists():
        spec = dataclasses.replace(FINGERS, skin_tone=1, sleeve="none", light="bright", false_blobs=0.0)
        renderer = Renderer(Scene(spec))
        sensor, no_disc = ColorSensor(spec, renderer.appearance), np.ones(len(HAND21.markers), dtype=bool)
        frames = [sensor.expose(renderer.render(k / 30.0, no_disc).color, k) for k in range(PICTURES)]
        target.parent.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(target, color_rgb=np.stack(frames))
    return target


def _run(which: str, *arguments: str) -> list[dict[str, object]]:
    python = _environment(which)
    environment = {**os.environ, "PYTHONPATH": str(_ROOT), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [python, "-m", "tests.bench.peer_run", which, *arguments],
        capture_output=True, text=True, cwd=_ROOT, env=environment, check=False,
    )  # fmt: skip
    if done.returncode:
        raise PeerMissingError(f"{' '.join(NEEDS[which])} did not run: {done.stderr.strip().splitlines()[-1:]}")
    rows: list[dict[str, object]] = json.loads(done.stdout.strip().splitlines()[-1])
    return rows


def report(carpus_ratio: float) -> Iterator[str]:
    """Time the peers and tell; ``carpus_ratio`` of a whole frame of Carpus to the plain step in its own run."""
    yield HEAD
    for which in NEEDS:
        try:
            rows = _run(which, *((str(_plain_hand()),) if which == "mediapipe" else ()))
        except (PeerMissingError, OSError) as fault:
            yield f"| {which} | – | – | – | – | {fault} |"
            continue
        plain = float(np.median(next(row["cpu_ms"] for row in rows if row["name"] == "plain")))  # type: ignore[arg-type]
        for row in rows:
            if row["name"] != "plain":
                times = np.asarray(row["cpu_ms"], dtype=np.float64)
                ratio = float(np.median(times)) / plain
                first = line(str(row["name"]), times.tolist(), plain).rsplit("|", 2)[0]
                yield f"{first}| {_times(ratio / carpus_ratio)} | {row['note']} |"


def _times(faster: float) -> str:
    return f"{faster:.1f} times quicker" if faster >= 1.0 else f"{1.0 / faster:.1f} times slower"
