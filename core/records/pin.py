"""PIN of the lock: stored as Argon2id, with a pause after too many tries.

It hides names, frames and results from passers-by. It protects no file: whoever may read the data folder needs no PIN,
and whoever may write there can remove it.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import ModuleType
from typing import Any

from carpus.core.model.errors import PinUncheckable
from carpus.core.platform.durable import replace_text, write_fault

PIN_FILE = "pin.json"
MIN_CHARACTERS, MAX_CHARACTERS = 4, 64
MAX_TRIES = 5
PAUSE = timedelta(minutes=1)


@dataclass(frozen=True, slots=True)
class PinAttempt:
    """Outcome of a try: correct, or the tries left before a pause, or the seconds of the pause."""

    is_correct: bool
    tries_left: int = MAX_TRIES
    pause_s: float = 0.0


class Pin:
    """PIN of a data folder."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / PIN_FILE

    @property
    def is_set(self) -> bool:
        """True if there is a PIN; with an unreadable file the lock stays closed."""
        return self._path.exists()

    def set(self, pin: str) -> None:
        """Set or change the PIN.

        Raises ValueError for a wrong length, :class:`OutputNotWritable`, :class:`PinUncheckable`.
        """
        argon2 = _argon2()
        if not MIN_CHARACTERS <= len(pin) <= MAX_CHARACTERS:
            raise ValueError(f"{len(pin)} signs")
        self._write({"pin": str(argon2.PasswordHasher().hash(pin)), "refused": 0, "since": ""})

    def remove(self) -> None:
        try:
            self._path.unlink(missing_ok=True)
        except OSError as cause:
            raise write_fault(self._path, cause) from cause

    def check(self, pin: str, now: datetime | None = None) -> PinAttempt:
        """Check a PIN; wrong tries are counted in the file. During a pause nothing is checked.

        Raises :class:`OutputNotWritable` if the try cannot be counted, :class:`PinUncheckable`.
        """
        argon2 = _argon2()
        when = now or datetime.now(UTC)
        kept = self._read()
        refused, since = kept["refused"], kept["since"]
        if refused >= MAX_TRIES and since is not None:
            waited = when - since
            if timedelta(0) <= waited < PAUSE:
                return PinAttempt(False, 0, float(math.ceil((PAUSE - waited).total_seconds())))
            refused = 0
        try:
            is_correct = bool(argon2.PasswordHasher().verify(kept["pin"], pin))
        except (argon2.exceptions.VerificationError, argon2.exceptions.InvalidHashError):
            is_correct = False
        content = {"pin": kept["pin"], "refused": 0 if is_correct else refused + 1, "since": when.isoformat()}
        if not is_correct or kept["refused"]:
            self._write(content)
        if is_correct:
            return PinAttempt(True)
        left = MAX_TRIES - refused - 1
        return PinAttempt(False, left, 0.0 if left else PAUSE.total_seconds())

    def _read(self) -> dict[str, Any]:
        try:
            content = json.loads(self._path.read_text(encoding="utf-8"))
            since = datetime.fromisoformat(content["since"]) if content["since"] else None
            refused = content["refused"]
            if isinstance(refused, bool) or not isinstance(refused, int) or (since and since.tzinfo is None):
                raise ValueError("no count")
            return {"pin": str(content["pin"]), "refused": max(0, refused), "since": since}
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return {"pin": "", "refused": 0, "since": None}

    def _write(self, content: dict[str, Any]) -> None:
        replace_text(self._path, json.dumps(content))


def _argon2() -> ModuleType:
    try:
        import argon2
    except ImportError as cause:  # also where its compiled part does not fit the computer
        raise PinUncheckable("argon2", str(cause)) from cause
    return argon2
