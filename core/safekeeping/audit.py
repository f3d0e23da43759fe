"""Who opened, changed, exported or erased what, and when: a file that is only ever added to.

One line of JSON for each deed. ``chain`` of a line is the SHA-256 of the chain before it and of the line itself, so
that a line changed, taken out or put in between is noticed at the lines after it. Lines taken off the end are noticed
only by somebody who knows how the log ended: every back-up does (:mod:`core.safekeeping.backup`).

Nobody's name is in it: patients and sessions stand there by the identities the program gave them, and the facts are
numbers and the program's own words.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, get_args

from carpus.core.durable import write_fault
from carpus.core.errors import OutputNotWritable
from carpus.core.private import private

if sys.platform != "win32":
    import fcntl

AUDIT_FILE = "audit.jsonl"
FIRST_CHAIN = "0" * 64
MOST_LINE_BYTES = 4096
MOST_INITIALS = 12

Deed = Literal[
    "opened", "recorded", "added", "changed", "exported", "reported", "set_aside", "taken_back", "moved", "renamed",
    "tracked_again", "recovered", "archived", "brought_back", "erase_begun", "erased", "backed_up", "backup_compared",
    "restored", "locked", "unlocked", "pin_refused", "pin_changed", "read_log", "encrypted",
    "decrypted", "entered_by_hand",
]  # fmt: skip
Kind = Literal["session", "patient", "everything", "program"]
By = Literal["window", "command"]
Fact = int | str

_IDENTITY = re.compile(r"[0-9a-z-]{0,64}")
_WORD = re.compile(r"[a-z0-9_.,-]{0,64}")
"""A fact in words is one of the program's own: neither capitals nor blanks, so that no name slips in by a path."""


@dataclass(frozen=True, slots=True)
class AuditEntry:
    """One deed. ``who`` the initials of the person, empty where none are set; ``identity`` of a session or patient."""

    number: int
    when: datetime
    who: str
    by: By
    did: Deed
    kind: Kind
    identity: str
    facts: Mapping[str, Fact] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class AuditReading:
    """``entries`` as written; ``breaks`` the numbers of lines at which the chain does not fit, ``torn`` those that end
    in the middle, as after a power cut; ``chain`` of the last line."""

    entries: tuple[AuditEntry, ...]
    breaks: tuple[int, ...]
    torn: tuple[int, ...]
    chain: str = FIRST_CHAIN

    @property
    def is_whole(self) -> bool:
        """Whether nothing was changed, put in between or taken out."""
        return not self.breaks


class AuditLog:
    """Adds to the log of one data folder; from several threads and programs at once."""

    def __init__(
        self,
        folder: Path,
        by: By,
        who: Callable[[], str] = lambda: "",
        now: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self.path = folder / AUDIT_FILE
        self.who = who
        self._by, self._now = by, now

    def note(self, did: Deed, kind: Kind, identity: str = "", **facts: Fact) -> None:
        """Write a deed down and bring it to the disk. Raises :class:`OutputNotWritable` or :class:`DiskFull`.

        ValueError for an identity or a fact that could be a name: a mistake of the caller. A session's identity is what
        its file says, and a damaged one may say anything: such a one is noted by its fingerprint.
        """
        if kind == "session" and not _IDENTITY.fullmatch(identity):
            identity = hashlib.sha256(identity.encode("utf-8", "backslashreplace")).hexdigest()[:32]
        if did not in get_args(Deed) or kind not in get_args(Kind) or not _IDENTITY.fullmatch(identity):
            raise ValueError(f"{did} {kind} {identity!r} is not of the log")
        if not all(isinstance(fact, int) or _WORD.fullmatch(fact) for fact in facts.values()):
            raise ValueError(f"facts {facts} could name somebody")
        body: dict[str, Any] = {
            "when": self._now().astimezone(UTC).isoformat(timespec="seconds"),
            "who": self.who()[:MOST_INITIALS],
            "by": self._by,
            "did": did,
            "kind": kind,
            "id": identity,
            "facts": facts,
        }
        try:
            with open(self.path, "a+b", opener=private) as file, _only_one(file.fileno()):
                number, chain, whole = _end(file)
                body = {"n": number + 1, **body}
                line = json.dumps({**body, "chain": _link(chain, body)}, ensure_ascii=False).encode()
                file.write((b"" if whole else b"\n") + line + b"\n")
                file.flush()
                os.fsync(file.fileno())
        except OSError as cause:
            raise write_fault(self.path, cause) from cause


def read_audit(folder: Path) -> AuditReading:
    """The whole log of a data folder, oldest first; empty where there is none. Never changes it."""
    try:
        lines = (folder / AUDIT_FILE).read_bytes().split(b"\n")
    except FileNotFoundError:
        return AuditReading((), (), ())
    except OSError as cause:
        raise OutputNotWritable(folder / AUDIT_FILE, cause.strerror or "") from cause
    entries: list[AuditEntry] = []
    breaks: list[int] = []
    torn: list[int] = []
    chain, number = FIRST_CHAIN, 0
    for place, line in enumerate(lines, 1):
        if not line:
            continue
        found = _parsed(line)
        if found is None:
            torn.append(place)
            continue
        entry, body, told = found
        if told != _link(chain, body) or entry.number != number + 1:
            breaks.append(place)
        entries.append(entry)
        chain, number = told, entry.number
    return AuditReading(tuple(entries), tuple(breaks), tuple(torn), chain)


def holds_chain(reading: AuditReading, folder: Path, chain: str) -> bool:
    """Whether a chain known from before, such as that of a back-up, is still in a log: else its end was taken off."""
    if chain in (FIRST_CHAIN, reading.chain):
        return True
    try:
        return chain.encode() in (folder / AUDIT_FILE).read_bytes()
    except OSError:
        return False


def _link(chain: str, body: Mapping[str, Any]) -> str:
    """The chain after a line."""
    text = json.dumps(body, ensure_ascii=False, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(f"{chain}{text}".encode()).hexdigest()


def _parsed(line: bytes) -> tuple[AuditEntry, dict[str, Any], str] | None:
    """What a line says, what its chain is of, and the chain; None for a line that is not whole."""
    try:
        body = json.loads(line)
        told = str(body.pop("chain"))
        when = datetime.fromisoformat(body["when"])
        if not isinstance(body["facts"], dict) or not isinstance(body["n"], int) or when.tzinfo is None:
            return None
        entry = AuditEntry(
            body["n"], when, str(body["who"]), body["by"], body["did"], body["kind"], str(body["id"]), body["facts"]
        )
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return entry, body, told


def _end(file: Any) -> tuple[int, str, bool]:
    """Number and chain of the last whole line, and whether the file ends with a whole line."""
    size = file.seek(0, os.SEEK_END)
    reach = 8 * MOST_LINE_BYTES
    while size:
        file.seek(max(0, size - reach))
        tail = file.read(reach)
        for line in reversed(tail.split(b"\n")):
            found = _parsed(line) if line else None
            if found is not None:
                return found[0].number, found[2], tail.endswith(b"\n")
        if reach >= size:
            return 0, FIRST_CHAIN, tail.endswith(b"\n")
        reach *= 8
    return 0, FIRST_CHAIN, True


@contextlib.contextmanager
def _only_one(descriptor: int) -> Iterator[None]:
    """One writer at a time, where the disk knows locks; elsewhere a second one would show as a break."""
    if sys.platform == "win32":
        yield
        return
    locked = False
    with contextlib.suppress(OSError):
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        locked = True
    try:
        yield
    finally:
        if locked:
            fcntl.flock(descriptor, fcntl.LOCK_UN)
