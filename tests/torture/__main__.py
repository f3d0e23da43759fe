"""``make torture``: everything that must not lose or let in anything, with its figures."""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from tests.torture import backup_kills, kills, mutations, store_kills, two_programs, write_kills  # noqa: E402
from tests.torture.readers import Outcome, Reader  # noqa: E402

MOST_S, MOST_BYTES = 2.0, 1_000_000_000
START = """
import sys, time
from pathlib import Path
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.records.library import Library
begin = time.monotonic()
library = Library(Path(sys.argv[1]))
recovered, faults = recover_sessions(library)
first = time.monotonic() - begin
library.close()
begin = time.monotonic()
library = Library(Path(sys.argv[1]))
again = recover_sessions(library)[1]
from carpus.core.records.session_list import read_file_states
apart = sum(bool(one.reason) for one in read_file_states(library.store).values())
patients = len(library.patients.search())
library.close()
print(f"{first:.2f} {time.monotonic() - begin:.2f} {len(faults)} {len(again)} {apart} {patients}")
"""


def kill_lines(count: int, folder: Path) -> Iterator[str]:
    """A line for each kind of kill."""
    for kind in kills.KINDS:
        done = [kills.kill_once(kind, number, folder / kind.replace(" ", "-") / str(number)) for number in range(count)]
        lost = [one.lost_s for one in done]
        line = f"kills, {kind}: {count}; lost {statistics.median(lost):.2f} s in the median, {max(lost):.2f} s at most"
        raw = [one.raw_lost_s for one in done if one.raw_lost_s]
        yield (
            line
            + (f", pictures {max(raw):.2f} s at most" if raw else "")
            + f"; {sum(one > kills.MOST_LOST_S for one in lost)} lost more than {kills.MOST_LOST_S:g} s"
            + "; every session opened, none wrongly complete"
        )


def read_mutations(kind: str, count: int, folder: Path) -> list[Outcome]:
    """Every damaged file of a kind, read."""
    original = mutations.sound(kind, folder / "sound")
    folder = folder / "mutated"
    folder.mkdir(parents=True)
    reader = Reader(kind)
    try:
        reader.read(-1, original)  # what is loaded for the first file is not the file's fault
        return [reader.read(number, mutations.mutated(kind, original, number, folder)) for number in range(count)]
    finally:
        reader.end()


def mutation_line(kind: str, outcomes: list[Outcome]) -> str:
    said = Counter(outcome.said for outcome in outcomes)
    most = ", ".join(f"{number} {what}" for what, number in said.most_common(4))
    longest = max(outcome.took_s for outcome in outcomes)
    largest = max(outcome.memory_bytes for outcome in outcomes)
    slow = sum(outcome.took_s > MOST_S for outcome in outcomes)
    return (
        f"damaged, {kind}: {len(outcomes)}; {most}; longest {longest:.2f} s ({slow} over {MOST_S:g} s), "
        f"most memory {largest / 1e6:.0f} MB"
    )


def start_line(count: int, folder: Path) -> str:
    """The program's start with every damaged session and part, and a damaged register, in its folder."""
    data = folder / "data"
    for kind in ("session", "part"):
        (data / "sessions" / kind).mkdir(parents=True)
        original = mutations.sound(kind, folder / f"sound {kind}")
        for number in range(count):
            mutations.mutated(kind, original, number, data / "sessions" / kind)
    register = mutations.sound("register", folder / "register")
    shutil.copy(mutations.mutated("register", register, 0, folder), data / "records.sqlite3")
    command = [sys.executable, "-c", START, str(data)]
    done = subprocess.run(command, cwd=kills.ROOT, capture_output=True, text=True, check=False, timeout=7200)
    assert done.returncode == 0, done.stderr
    first, again, told, told_again, apart, patients = done.stdout.split()
    assert told_again == "0", "told again at the next start"
    return (
        f"start, {2 * count} damaged files and a damaged register in the folder: first {first} s, again {again} s; "
        f"{told} messages, {apart} set apart, {patients} patients"
    )


def live_lines(minutes: float, folder: Path) -> Iterator[str]:
    """A long recording: memory, descriptors, losses."""
    folder.mkdir()
    command = [sys.executable, "-m", "tests.torture.recorder", str(folder), "--seconds", str(60.0 * minutes)]
    with subprocess.Popen(command, cwd=kills.ROOT, stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout.readline() == "begun\n"
        seen: list[tuple[float, float, int]] = []
        begin = time.monotonic()
        while program.poll() is None:
            try:
                status = Path(f"/proc/{program.pid}/status").read_text()
                memory = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) / 1e3
                seen.append((time.monotonic() - begin, memory, len(list(Path(f"/proc/{program.pid}/fd").iterdir()))))
            except (OSError, StopIteration):
                break
            time.sleep(min(5.0, 3.0 * minutes))
        said = program.stdout.read().strip()
    settled = [one for one in seen if one[0] > 0.3 * seen[-1][0]] or seen
    yield (
        f"live, {minutes:g} min: memory {settled[0][1]:.0f} to {settled[-1][1]:.0f} MB, descriptors {settled[0][2]} to "
        f"{settled[-1][2]}; {said}"
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.torture", description=__doc__)
    parser.add_argument("parts", nargs="*", help="kills, writes, backups, records, two, mutations, start; or live")
    parser.add_argument("--kills", type=int, default=17, help="of each of six kinds")
    parser.add_argument("--every", type=int, default=1, help="of the steps at which the writing is killed")
    parser.add_argument("--random", type=int, default=1000, help="kills of the writing by the clock")
    parser.add_argument("--backup-kills", type=int, default=100, help="of each of three kinds")
    parser.add_argument("--record-kills", type=int, default=100, help="of each of four kinds")
    parser.add_argument("--files", type=int, default=2000, help="damaged files of each of eight kinds")
    parser.add_argument("--minutes", type=float, default=30.0, help="of two programs; of the live part twice that")
    parser.add_argument("--changes", type=int, default=10_000, help="of the two programs")
    told = parser.parse_args()
    parts = told.parts or ["kills", "writes", "backups", "records", "two", "mutations", "start"]
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} processors", flush=True)
    print(f"load at the start {os.getloadavg()[0]:.1f}", flush=True)
    wrong: list[Outcome] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if "kills" in parts:
            for line in kill_lines(told.kills, folder):
                print(line, flush=True)
        if "writes" in parts:
            for line in write_kills.lines(told.every, told.random, folder / "writes"):
                print(line, flush=True)
        if "backups" in parts:
            for kind in backup_kills.KINDS:
                print(backup_kills.line(kind, told.backup_kills, folder / kind), flush=True)
        if "records" in parts:
            for kind in store_kills.KINDS:
                print(store_kills.line(kind, told.record_kills, folder / kind), flush=True)
        if "two" in parts:
            print(two_programs.line(told.changes, 60.0 * told.minutes, 10.0, folder / "two"), flush=True)
        if "mutations" in parts:
            for kind in mutations.KINDS:
                outcomes = read_mutations(kind, told.files, folder / kind)
                print(mutation_line(kind, outcomes), flush=True)
                wrong += [one for one in outcomes if not one.good or one.memory_bytes > MOST_BYTES]
                shutil.rmtree(folder / kind)
        if "start" in parts:
            print(start_line(told.files, folder / "start"), flush=True)
        if "live" in parts:
            for line in live_lines(2.0 * told.minutes, folder / "live"):
                print(line, flush=True)
    for one in wrong:
        print(f"WRONG: {one}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
