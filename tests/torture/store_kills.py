"""The store killed while it writes: comments, corrections, an erasure, on a server. What was said to be done
is there once, nothing is half, nothing is left of what was erased."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
import uuid
from pathlib import Path

import numpy as np

from carpus.core.records import erasure, session_records
from carpus.core.records.data_folder import DataFolder
from tests.records.postgres import Cluster
from tests.records.samples import HERON, LINDEN, T0, House, measure, open_store, traces
from tests.torture.kills import ROOT

KINDS = ("comment", "correction", "erasure", "on a server")
LONGEST_S = 0.4
NAMES = ("Linden", "Erika Mustermann")
CHILD = """
import itertools, sys
from pathlib import Path
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.records import erasure, session_records
from tests.records.samples import open_store
kind, folder, session_id, url = sys.argv[1:]
with open_store(Path(folder), url) as house:
    print("begun", flush=True)
    if kind == "erasure":
        erasure.erase(house.store, erasure.plan_patient(house.store, house.index.owner_id(session_id)), house.log)
        print("done", flush=True)
    version = 0
    for number in itertools.count() if kind != "erasure" else ():
        if kind == "correction":
            choices = RepetitionChoices({0: str(number)})
            version = session_records.save_choices(house.store, session_id, choices, version)
        else:
            session_records.add_comment(house.store, session_id, str(number), "AB")
        print(number, flush=True)
"""


def line(kind: str, count: int, folder: Path) -> str:
    """So many kills of a kind, each looked at; AssertionError for anything lost, half, twice or left."""
    folder.mkdir(parents=True)
    cluster = Cluster() if kind == "on a server" else None
    try:
        done = [_kill(kind, number, folder / str(number), cluster) for number in range(count)]
    finally:
        if cluster is not None:
            cluster.end()
    return f"kills, {kind}: {count}, {sum(done)} after something was said to be done; nothing lost, half, twice or left"


def _kill(kind: str, number: int, folder: Path, cluster: Cluster | None) -> bool:
    url = "" if cluster is None else cluster.new_database(f"c{uuid.uuid4().hex[:12]}")
    with open_store(folder, url) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        session_id, other = measure(house, linden, T0), measure(house, heron, T0)
    command = [sys.executable, "-c", CHILD, kind, str(folder), session_id, url]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "begun\n"
        time.sleep(np.random.default_rng(number).uniform(0.0, 0.1 if kind == "erasure" else LONGEST_S))
        child.kill()
        said = child.stdout.read().split()
    said = said if not said or said[-1].isdigit() or said[-1] == "done" else said[:-1]
    if kind == "erasure":
        _check_erased(folder, linden, session_id, bool(said))
    else:
        with open_store(folder, url) as house:
            _check_written(house, kind, session_id, [int(one) for one in said])
            assert house.store.startup_faults == [], "the store was not damaged"
    with open_store(folder, url) as house:
        assert house.index.get(other).path.exists()
    shutil.rmtree(folder)
    return bool(said)


def _check_written(house: House, kind: str, session_id: str, said: list[int]) -> None:
    if kind == "correction":
        choices, _ = session_records.read_choices(house.store, session_id)
        assert not said or int(choices.excluded[0]) in (said[-1], said[-1] + 1)
    else:
        there = [int(one) for one in session_records.read_comments(house.store, session_id)]
        assert there == list(range(len(there)))
        assert len(there) - len(said) in (0, 1)


def _check_erased(folder: Path, patient_id: str, session_id: str, done: bool) -> None:
    DataFolder(folder).close()  # the next start
    with open_store(folder) as house:
        begun = "Linden 42" not in house.names()
        assert begun or not done
        if not begun:
            assert house.index.get(session_id).path.exists()
            assert erasure.plan_patient(house.store, patient_id).files
    if begun:
        assert traces(folder, *NAMES, patient_id, session_id) == []
