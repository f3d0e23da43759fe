"""The log of deeds: only added to, chained, by several programs at once, without names."""

from __future__ import annotations

import json
import subprocess
import sys
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from carpus.core.errors import OutputNotWritable
from carpus.core.safekeeping.audit import AUDIT_FILE, FIRST_CHAIN, AuditLog, holds_chain, read_audit

ROOT = Path(__file__).parents[2]
T0 = datetime(2026, 11, 20, 9, 0, tzinfo=UTC)


def written(folder: Path, count: int = 6) -> AuditLog:
    log = AuditLog(folder, "window", lambda: "AB", lambda: T0 + timedelta(minutes=len(lines(folder))))
    for number in range(count):
        log.note("opened", "session", f"{number:032x}", files=number)
    return log


def lines(folder: Path) -> list[bytes]:
    path = folder / AUDIT_FILE
    return path.read_bytes().splitlines() if path.exists() else []


def test_what_was_written_is_read_in_order(tmp_path: Path) -> None:
    assert read_audit(tmp_path).entries == ()
    written(tmp_path)
    reading = read_audit(tmp_path)
    assert reading.is_whole
    assert [entry.number for entry in reading.entries] == [1, 2, 3, 4, 5, 6]
    last = reading.entries[-1]
    assert (last.who, last.by, last.did, last.kind, last.identity) == ("AB", "window", "opened", "session", f"{5:032x}")
    assert (last.when, dict(last.facts)) == (T0 + timedelta(minutes=5), {"files": 5})
    assert (tmp_path / AUDIT_FILE).stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("place", range(6))
def test_every_line_that_is_changed_is_noticed(tmp_path: Path, place: int) -> None:
    written(tmp_path)
    kept = lines(tmp_path)
    body = json.loads(kept[place])
    for key, value in (
        ("who", "XY"),
        ("id", "0"),
        ("did", "added"),
        ("facts", {}),
        ("n", 17),
        ("when", body["when"][:-6] + "+01:00"),
    ):
        changed = [*kept]
        changed[place] = json.dumps({**body, key: value}).encode()
        (tmp_path / AUDIT_FILE).write_bytes(b"\n".join([*changed, b""]))
        if changed[place] != kept[place] and {**body, key: value} != body:
            assert not read_audit(tmp_path).is_whole, key


def test_lines_taken_out_or_swapped_are_noticed(tmp_path: Path) -> None:
    written(tmp_path)
    kept = lines(tmp_path)
    for changed in ([*kept[:2], *kept[3:]], kept[1:], [kept[1], kept[0], *kept[2:]], [*kept, kept[-1]]):
        (tmp_path / AUDIT_FILE).write_bytes(b"\n".join([*changed, b""]))
        assert not read_audit(tmp_path).is_whole


def test_an_end_taken_off_is_known_to_whoever_knew_the_end(tmp_path: Path) -> None:
    written(tmp_path)
    chain = read_audit(tmp_path).chain
    (tmp_path / AUDIT_FILE).write_bytes(b"\n".join([*lines(tmp_path)[:4], b""]))
    reading = read_audit(tmp_path)
    assert reading.is_whole
    assert not holds_chain(reading, tmp_path, chain)
    assert holds_chain(reading, tmp_path, FIRST_CHAIN)
    assert holds_chain(reading, tmp_path, reading.chain)


def test_a_power_cut_in_the_middle_of_a_line_breaks_nothing(tmp_path: Path) -> None:
    log = written(tmp_path, 3)
    path = tmp_path / AUDIT_FILE
    path.write_bytes(path.read_bytes() + b'{"n": 4, "when": "20')
    log.note("erased", "session", "0" * 32, files=3)
    reading = read_audit(tmp_path)
    assert (reading.is_whole, reading.torn) == (True, (4,))
    assert [entry.number for entry in reading.entries] == [1, 2, 3, 4]


def test_programs_write_at_the_same_time(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from carpus.core.safekeeping.audit import AuditLog\n"
        "log = AuditLog(Path(sys.argv[1]), 'command')\n"
        "for number in range(20): log.note('opened', 'session', str(number))"
    )
    running = [subprocess.Popen([sys.executable, "-c", code, str(tmp_path)], cwd=ROOT) for _ in range(3)]
    assert [one.wait(60) for one in running] == [0, 0, 0]
    reading = read_audit(tmp_path)
    assert (reading.is_whole, len(reading.entries)) == (True, 60)


@pytest.mark.parametrize(
    ("identity", "facts"),
    [("Linden 42", {}), ("", {"path": "/data/sessions/Linden-42/s.h5"}), ("", {"name": "Ada"}), ("x" * 65, {})],
)
def test_a_name_is_refused(tmp_path: Path, identity: str, facts: dict[str, str]) -> None:
    with pytest.raises(ValueError):
        AuditLog(tmp_path, "window").note("opened", "patient", identity, **facts)
    assert lines(tmp_path) == []


def test_a_session_is_noted_whatever_a_damaged_file_says_it_is(tmp_path: Path) -> None:
    said = (" ", "Linden 42", "wr\udc80st", "x" * 65)
    for identity in said:
        AuditLog(tmp_path, "window").note("recovered", "session", identity)
    noted = [entry.identity for entry in read_audit(tmp_path).entries]
    assert len(set(noted)) == len(said)
    assert all(len(one) == 32 for one in noted)
    assert "Linden" not in (tmp_path / AUDIT_FILE).read_text(encoding="utf-8")


def test_a_log_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / AUDIT_FILE).mkdir()
    with pytest.raises(OutputNotWritable):
        AuditLog(tmp_path, "window").note("locked", "program")
