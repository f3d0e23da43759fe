"""Encrypts what comes into a data folder while the program runs, in a thread of its own."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from carpus.core.encryption import keys
from carpus.core.errors import CarpusFault, EncryptionUnfinished
from carpus.core.safekeeping.encryption import end_switching_off, sweep

END_S = 30.0
"""What was recorded last is encrypted before the program ends, if that takes no longer."""


class Encrypting:
    """Looks through the folder whenever it is woken. ``may_work`` is asked between two files: not while a recording
    runs. ``told`` hears of each file that could not be exchanged, once."""

    def __init__(self, folder: Path, told: Callable[[CarpusFault], None]) -> None:
        self._folder, self._told = folder, told
        self.may_work: Callable[[], bool] = lambda: True
        self._said: set[str] = set()
        self._wanted = threading.Event()
        self._ending = threading.Event()
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()

    def wake(self) -> None:
        """Something came, or may have; nothing is done in a folder without a key."""
        with self._lock:
            if self._ending.is_set() or not keys.has_key(self._folder):
                return
            self._wanted.set()
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="encrypting", daemon=True)
                self._thread.start()

    def end(self) -> None:
        """Finish what is waiting, as far as that goes in :data:`END_S`; may be called twice."""
        with self._lock:
            self._ending.set()
            self._wanted.set()
            thread = self._thread
        if thread is not None:
            thread.join(END_S)

    def _run(self) -> None:
        while True:
            self._wanted.wait()
            self._wanted.clear()
            try:
                self._look_through()
            except CarpusFault as fault:
                self._tell(fault)
            if self._ending.is_set():
                return

    def _look_through(self) -> None:
        swept = sweep(self._folder, stopping=lambda: not self.may_work())
        for fault in swept.left:
            self._tell(fault)
        if keys.has_key(self._folder) and not keys.is_on(self._folder) and self.may_work() and not swept.left:
            with suppress(EncryptionUnfinished):  # a list of patients is not plain yet: at the next start
                end_switching_off(self._folder)

    def _tell(self, fault: CarpusFault) -> None:
        if fault.subject not in self._said:
            self._said.add(fault.subject)
            self._told(fault)
