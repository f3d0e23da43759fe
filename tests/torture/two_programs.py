"""Two programs on one PostgreSQL and one share, the server killed, stopped, frozen and cut off meanwhile: every change
is there once, or somebody was told of it."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from datetime import timedelta
from pathlib import Path

from sqlalchemy import create_engine, select
from sqlalchemy.pool import NullPool

from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.errors import ConcurrentChange, PatientListBusy, PseudonymTaken, ServerUnavailable
from carpus.core.records import patients, session_records
from carpus.core.records.schema import COMMENT, CORRECTION, MANUAL_MEASUREMENT, PATIENT, SESSION
from carpus.core.records.values import Patient
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import verify
from tests.records.postgres import Cluster
from tests.records.samples import T0, House, measure, opened
from tests.torture.kills import ROOT
from tests.torture.wire import Wire

NAMES = ("a", "b")
SHARED_PATIENTS = 4
TROUBLES = ("server killed", "one connection's server killed", "stopped", "frozen", "cut off", "answers lost")
SETTLE_S = 120.0
WEIGHTS = {"comment": 35, "by hand": 20, "entry": 22, "correction": 15, "patient": 5, "session": 3}


@dataclass
class Ledger:
    """What a program did, by marks. ``made``: changes that were said to be kept, by kind; ``refused``: those that
    somebody else was quicker with; ``unsure``: those during which the server went away."""

    made: dict[str, list[str]] = field(default_factory=lambda: {kind: [] for kind in WEIGHTS})
    refused: list[str] = field(default_factory=list)
    unsure: list[str] = field(default_factory=list)
    longest_s: float = 0.0


def program(folder: Path, share: Path, url: str, name: str, count: int, seconds: float, chance: random.Random) -> None:
    """One of the two; says what it did at the end."""
    ledger = Ledger()
    with opened(folder, url, sessions=share) as house:
        print("begun", flush=True)
        begin = time.monotonic()
        for number in range(count):
            kind = chance.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
            mark, since = f"{name}{number}", time.monotonic()
            try:
                ledger.made[kind].append(_do(house, kind, mark, number, chance))
            except (ConcurrentChange, PseudonymTaken):
                ledger.refused.append(mark)
            except (ServerUnavailable, PatientListBusy):
                ledger.unsure.append(mark)
                with suppress(ServerUnavailable, PatientListBusy):
                    house.store.server.ping()  # type: ignore[union-attr]
            ledger.longest_s = max(ledger.longest_s, time.monotonic() - since)
            time.sleep(max(begin + seconds * (number + 1) / count - time.monotonic(), 0.0))
    print(json.dumps(asdict(ledger)), flush=True)


def _do(house: House, kind: str, mark: str, number: int, chance: random.Random) -> str:
    """One change; the mark by which it is found again."""
    store, shared = house.store, f"{chance.randrange(SHARED_PATIENTS)}"
    patient_id = house.patients.id_of_pseudonym(f"Shared {shared}")
    session_id = house.index.patient_sessions(patient_id)[-1].session_id
    if kind == "comment":
        session_records.add_comment(store, session_id, mark, "AB")
    elif kind == "by hand":
        value = ManualValue("WRIST_ROUND", "", "right", T0.date(), (16.0,), mark)
        patients.add_manual_measurements(store, patient_id, [value])
    elif kind == "entry":
        read = house.patients.get(patient_id)
        time.sleep(chance.uniform(0.0, 0.05))  # somebody types
        house.patients.change(replace(read, note=f"{read.note} {mark}"))
    elif kind == "correction":
        before, version = session_records.read_choices(store, session_id)
        time.sleep(chance.uniform(0.0, 0.05))
        kept = RepetitionChoices({0: mark}, {}, True, f"{before.session_exclusion_reason} {mark}")
        session_records.save_choices(store, session_id, kept, version)
    elif kind == "patient":
        return house.patients.add(Patient(mark if number % 2 else f"Both {number // 20}", "left"))
    else:
        return measure(house, patient_id, T0 + timedelta(days=400 * (mark[0] == "b"), seconds=number + 1))
    return mark


class Trouble(threading.Thread):
    """Makes it until ended: ``made`` says of which kind how often."""

    def __init__(self, cluster: Cluster, wire: Wire, longest_s: float) -> None:
        super().__init__(daemon=True)
        self._cluster, self._wire, self._longest_s = cluster, wire, longest_s
        self._chance, self._ends = random.Random(11), threading.Event()
        self.made: Counter[str] = Counter()

    def run(self) -> None:
        kinds: list[str] = []
        while not self._ends.wait(self._chance.uniform(0.1, self._longest_s)):
            kinds = kinds or self._chance.sample(TROUBLES, len(TROUBLES))
            kind = kinds.pop()
            self._make(kind, self._chance.uniform(0.1, self._longest_s))
            self.made[kind] += 1

    def end(self) -> None:
        """And all is well again."""
        self._ends.set()
        with suppress(RuntimeError):  # not begun
            self.join()

    def _make(self, kind: str, lasts_s: float) -> None:
        if kind in ("server killed", "stopped"):
            self._cluster.kill() if kind == "server killed" else self._cluster.stop("fast")
            time.sleep(lasts_s)
            self._cluster.start()
        elif kind == "frozen":
            frozen = self._cluster.processes()
            _signal(frozen, signal.SIGSTOP)
            time.sleep(lasts_s)
            _signal(frozen, signal.SIGCONT)
        elif kind == "one connection's server killed":
            _signal(self._cluster.processes("carpus")[:1], signal.SIGKILL)
        else:
            self._wire.is_whole, self._wire.answers_come = kind != "cut off", kind != "answers lost"
            if kind == "cut off":
                self._wire.cut()
            time.sleep(lasts_s)
            self._wire.is_whole = True
            self._wire.cut()
            self._wire.answers_come = True


def _signal(processes: list[int], which: signal.Signals) -> None:
    for one in processes:
        with suppress(ProcessLookupError):
            os.kill(one, which)


def line(count: int, seconds: float, longest_s: float, folder: Path) -> str:
    """So many changes in so many seconds; AssertionError for any that is neither there once nor told."""
    folder.mkdir(parents=True)
    share, cluster = folder / "share", Cluster()
    share.mkdir()
    wire = Wire(cluster.port)
    try:
        direct = cluster.new_database("clinic")
        url = direct.replace(str(cluster.port), str(wire.port))
        with opened(folder / "a", url, sessions=share) as house:
            for number in range(SHARED_PATIENTS):
                measure(house, house.patients.add(Patient(f"Shared {number}", "right")), T0)
            ids = {str(row.id) for row in house.store.rows(select(SESSION.c.id))}
        ledgers, trouble = _run(cluster, wire, url, folder, count, seconds, longest_s)
        conflicts = _check(direct, share, ledgers, ids)
    finally:
        wire.close()
        cluster.end()
    shutil.rmtree(folder)
    return (
        f"two programs, one server: {count} changes in {seconds / 60:.1f} min, "
        f"{', '.join(f'{kind} {number}' for kind, number in trouble.items())}; each there once or told: "
        f"{conflicts} conflicts told, {sum(len(one.unsure) for one in ledgers)} times the server was away, "
        f"the longest change {max(one.longest_s for one in ledgers):.1f} s"
    )


def _run(
    cluster: Cluster, wire: Wire, url: str, folder: Path, count: int, seconds: float, longest_s: float
) -> tuple[list[Ledger], Counter[str]]:
    command = [sys.executable, "-m", "tests.torture.two_programs", str(folder / "share"), url]
    running = [
        subprocess.Popen(
            [*command, str(folder / name), name, str(count // 2), str(seconds)], cwd=ROOT, text=True,
            stdout=subprocess.PIPE,
        )
        for name in NAMES
    ]  # fmt: skip
    trouble = Trouble(cluster, wire, longest_s)
    try:
        for one in running:
            assert one.stdout.readline() == "begun\n"
        trouble.start()
        said = [one.communicate(timeout=20 * seconds + SETTLE_S)[0] for one in running]
    finally:
        for one in running:
            one.kill()
            one.wait()
        trouble.end()
    return [Ledger(**json.loads(one)) for one in said], trouble.made


def _check(url: str, share: Path, ledgers: list[Ledger], sessions_before: set[str]) -> int:
    """How many conflicts were told."""
    engine = create_engine(url.replace("postgresql", "postgresql+psycopg"), poolclass=NullPool)

    def stored(query: object) -> list[str]:
        with engine.connect() as connection:
            return sorted(" ".join(str(row[0]) for row in connection.execute(query)).split())  # type: ignore[call-overload]

    def made(kind: str) -> list[str]:
        return sorted(mark for one in ledgers for mark in one.made[kind])

    unsure = {mark for one in ledgers for mark in one.unsure}
    assert {*made("comment")} <= {*stored(select(COMMENT.c.text))} <= {*made("comment")} | unsure
    assert {*made("by hand")} <= {*stored(select(MANUAL_MEASUREMENT.c.place))} <= {*made("by hand")} | unsure
    sessions = set(stored(select(SESSION.c.id))) - sessions_before
    assert set(made("session")) <= sessions
    for path in stored(select(SESSION.c.path)):
        assert verify(share / path).has_checksum
    there = set(stored(select(PATIENT.c.id).where(PATIENT.c.pseudonym.not_like("Shared%"))))
    assert set(made("patient")) <= there
    edits = [stored(query) for query in (select(PATIENT.c.note), select(CORRECTION.c.reason))]
    for marks in (*edits, stored(select(COMMENT.c.text)), stored(select(MANUAL_MEASUREMENT.c.place))):
        assert len(marks) == len(set(marks)), "a change made twice"
    found = {mark for marks in edits for mark in marks}
    assert set(made("entry") + made("correction")) <= found, "said to be kept, and not there"
    assert not found & {mark for one in ledgers for mark in one.refused}, "told as refused, and there"
    return sum(len(one.refused) for one in ledgers)


def main() -> None:
    share, url, folder, name, count, seconds = sys.argv[1:]
    program(Path(folder), Path(share), url, name, int(count), float(seconds), random.Random(name))


if __name__ == "__main__":
    main()
