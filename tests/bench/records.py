"""How long lists, search and progress of a large store take: 100,000 patients and a million sessions, generated.

``python -m tests.bench.records PATIENTS --server`` says what so many cost on a PostgreSQL: sizes, times, and what each
computer that is on asks of the server.
"""

from __future__ import annotations

import itertools
import os
import random
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from datetime import UTC, datetime, timedelta
from pathlib import Path

import psycopg
from sqlalchemy import insert

from carpus.core.model.names import fold_name
from carpus.core.records.database import STORE_FILE
from carpus.core.records.patients import WORDS, Patients
from carpus.core.records.schema import COMMENT, PATIENT, SESSION
from carpus.core.records.session_list import SessionList
from carpus.core.records.session_records import read_comments
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from tests.records.postgres import Cluster
from tests.records.samples import opened

PATIENTS, SESSIONS_EACH, AT_ONCE = 100_000, 10, 2_000
FIRST = datetime(2016, 1, 1, 8, tzinfo=UTC)


def fill(store: Store, patients: int) -> None:
    """People with names, notes, and ten sessions each over ten years; every tenth session has a comment."""
    rng = random.Random(7)
    for start in range(0, patients, AT_ONCE):
        people, sessions, said = [], [], []
        for number in range(start, min(start + AT_ONCE, patients)):
            patient_id, pseudonym = f"{number:032x}", f"{rng.choice(WORDS)} {number}"
            name = f"{rng.choice(WORDS)}mann, {rng.choice(WORDS)}"
            days = sorted(rng.randrange(3650) for _ in range(SESSIONS_EACH))
            when = [FIRST + timedelta(days=day, minutes=rng.randrange(600)) for day in days]
            people.append({
                "id": patient_id, "pseudonym_key": fold_name(pseudonym), "pseudonym": pseudonym, "name": name,
                "side": "right", "dominance": "right", "note": "distal radius",
                "search": fold_name(f"{pseudonym} {name} distal radius"),
                "sessions": SESSIONS_EACH, "results": SESSIONS_EACH, "last_session": when[-1].isoformat(),
                "last_s": when[-1].timestamp(), "last_exercise": "WRIST_FE", "added_s": when[0].timestamp(),
            })  # fmt: skip
            for place, at in enumerate(when):
                session_id = f"{number:024x}{place:08x}"
                sessions.append({
                    "id": session_id, "patient_id": patient_id, "path": f"{patient_id}/{at:%Y-%m-%d_%H%M%S}_{place}.h5",
                    "recording_id": session_id, "recorded": at.isoformat(),
                    "recorded_s": at.timestamp(), "created": at.isoformat(), "created_s": at.timestamp(),
                    "exercise": "WRIST_FE", "hand": "right", "frames": 900, "duration_s": 30.0, "complete": 1,
                    "size": 4_000_000,
                })  # fmt: skip
            said.append({"id": f"c{number:031x}", "session_id": sessions[-1]["id"], "text": "Less swelling.",
                         "by": "AB", "entered": when[-1].isoformat(), "entered_ns": 0})  # fmt: skip
        with store._database.writing() as connection:
            connection.execute(insert(PATIENT), people)
            connection.execute(insert(SESSION), sessions)
            connection.execute(insert(COMMENT), said)


def timed(what: Callable[[], object]) -> str:
    """Median and worst of twenty calls, and the processor's time of one, which other programs do not lengthen."""
    took = []
    busy = time.process_time()
    for _ in range(20):
        begin = time.perf_counter()
        what()
        took.append(time.perf_counter() - begin)
    busy = (time.process_time() - busy) / len(took)
    return f"{statistics.median(took) * 1e3:7.1f} ms, worst {max(took) * 1e3:7.1f} ms, processor {busy * 1e3:7.1f} ms"


COMPUTERS, WATCHED_S = 10, 30.0


def of_server(patients: int, folder: Path) -> None:
    """Sizes and costs with a server; all on one computer."""
    cluster = Cluster()
    try:
        url = cluster.new_database("bench")
        with opened(folder / "0") as house:
            fill(house.store, patients)
        begin = time.perf_counter()
        with opened(folder / "0", url) as house:
            house.names("nobody")
            print(f"the first computer brings all of it: {time.perf_counter() - begin:.0f} s")
            print(f"list of the last 200: {timed(lambda: house.patients.search(limit=200))}")
            print(f"search: {timed(lambda: house.patients.search('oak 77', limit=200))}")
            number = itertools.count()
            print(f"a patient entered: {timed(lambda: house.patients.add(Patient(f'New {next(number)}', 'left')))}")
        with psycopg.connect(url) as line:
            there = line.execute("SELECT pg_database_size('bench')").fetchone()
        print(f"size on the server {there[0] / 1e6 if there else 0:.0f} MB")
        with ExitStack() as on:
            for computer in range(COMPUTERS):
                on.enter_context(opened(folder / f"computer {computer}", url)).names("nobody")
            before = {one: _busy_s(one) for one in cluster.processes("carpus")}
            time.sleep(WATCHED_S)
            after = {one: _busy_s(one) for one in cluster.processes("carpus")}
            each = [(after[one] - before[one]) / WATCHED_S for one in before.keys() & after.keys()]
            memory = [_own_mb(one) for one in after]
            print(
                f"{COMPUTERS} computers on, nobody types: {len(after)} lines, each {statistics.mean(each) * 1e3:.2f} "
                f"ms of the server's processor a second and {statistics.mean(memory):.1f} MB of its memory"
            )
    finally:
        cluster.end()


def _busy_s(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _own_mb(process: int) -> float:
    lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith("Private")) / 1e3


def main() -> None:
    patients = int(sys.argv[1]) if len(sys.argv) > 1 else PATIENTS
    if "--server" in sys.argv:
        with tempfile.TemporaryDirectory() as folder:
            of_server(patients, Path(folder))
        return
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        store = Store(Path(folder))
        fill(store, patients)
        print(f"{patients} patients, {patients * SESSIONS_EACH} sessions: made in {time.perf_counter() - begin:.0f} s")
        store.close()
        print(f"size {(Path(folder) / STORE_FILE).stat().st_size / 1e6:.0f} MB")
        begin = time.perf_counter()
        store = Store(Path(folder))
        print(f"opened in {(time.perf_counter() - begin) * 1e3:.0f} ms")
        people, sessions = Patients(store), SessionList(store)
        somebody = f"{patients // 2:032x}"
        last = sessions.patient_sessions(somebody)[0].session_id
        for name, what in {
            "list, the last 200": lambda: people.search(limit=200),
            "search of a part of a name": lambda: people.search("kestrelmann lin", limit=200),
            "search of a number": lambda: people.search(str(patients // 2), limit=200),
            "search of nothing there": lambda: people.search("zzzz", limit=200),
            "sessions of a patient": lambda: sessions.patient_sessions(somebody),
            "progress: sessions and comments": lambda: [
                read_comments(store, one.session_id) for one in sessions.patient_sessions(somebody)
            ],
            "one session by identity": lambda: sessions.get(last),
            "a patient changed": lambda: people.archive(somebody) or people.unarchive(somebody),
        }.items():
            print(f"{name:34} {timed(what)}")
        store.close()


if __name__ == "__main__":
    main()
