"""Encryption in the window: switched on and off in the settings, and the PIN asked for before anything is opened."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEventLoop, QObject, Signal

from carpus.core.encryption import keys
from carpus.core.errors import CarpusFault, KeyRefused
from carpus.core.library.library import Encrypted, Library
from carpus.core.safekeeping.pin import Pin
from carpus.ui.background import Background
from carpus.ui.records.encrypt_sheet import EncryptionCard, EncryptSheet
from carpus.ui.records.lock_sheet import LockSheet
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.app.desktop.journey import Journey

END_MS = 600_000


class SwitchingEncryption(QObject):
    """``stepped`` carries the percent done, from another thread; ``changed`` that there is another PIN."""

    stepped = Signal(int)
    changed = Signal()

    def __init__(
        self, journey: Journey, shell: Shell, theme: Theme, library: Library, *, is_recording: Callable[[], bool]
    ) -> None:
        super().__init__(journey)
        self._journey, self._library, self._is_recording = journey, library, is_recording
        self._background = Background()
        self._running = False
        self.card = EncryptionCard(theme)
        self.card.wanted.connect(self.ask)
        self.sheet = EncryptSheet(shell.stage, theme)
        self.sheet.on_wanted.connect(self._switch_on)
        self.sheet.off_wanted.connect(self._switch_off)
        self.stepped.connect(self.sheet.show_progress)
        library.encrypting.may_work = lambda: not is_recording()
        self._show()

    @property
    def is_at_work(self) -> bool:
        """Whether something runs that ends with the window."""
        return self._background.busy

    def end(self) -> None:
        """The window closes; what runs is waited for."""
        self._background.wait(END_MS)

    def ask(self) -> None:
        """What shall be done; nothing while a recording runs."""
        if self._is_recording() or self._running:
            return
        folder = self._library.folder
        is_on = keys.has_key(folder)
        self.sheet.begin(turning_on=not is_on, has_pin=is_on or Pin(folder).is_set)

    def _switch_on(self, old: str, new: str) -> None:
        if self._running or (Pin(self._library.folder).is_set and not self._is_pin(old)):
            return
        self._begin()
        self._background.run(lambda: self._encrypted(new), self._is_on, self._failed, self)

    def _encrypted(self, pin: str) -> Encrypted:
        done = self._library.encrypt(pin, self._step)
        with suppress(CarpusFault):  # the key's PIN counts, and is kept here too at the next start
            Pin(self._library.folder).set(pin)
        return done

    def _switch_off(self, pin: str) -> None:
        if self._running or not self._is_pin(pin):
            return
        self._begin()
        self._background.run(lambda: self._library.decrypt(self._step), self._is_off, self._failed, self)

    def _is_pin(self, typed: str) -> bool:
        folder = self._library.folder
        if keys.has_key(folder) and keys.opens(folder, typed):
            return True
        tried = Pin(folder).try_it(typed)
        if tried.opened and not keys.has_key(folder):
            return True
        self._library.note("pin_refused", left=tried.left)
        wait = self.tr("Too many tries. The next one in {seconds} s.").format(seconds=round(tried.pause_s))
        self.sheet.say(wait if tried.pause_s else self.tr("The PIN until now is another one."))
        return False

    def _begin(self) -> None:
        self._running = True
        self.sheet.show_progress(0)

    def _step(self, done: int, total: int) -> None:
        self.stepped.emit(100 * done // total)

    def _is_on(self, done: Encrypted) -> None:
        self._end()
        self.sheet.show_code(done.code)
        self._tell(done.told)

    def _is_off(self, told: Sequence[CarpusFault]) -> None:
        self._end()
        self.sheet.close_sheet()
        self._tell(told)

    def _failed(self, fault: Exception) -> None:
        self._end()
        self.sheet.close_sheet()
        self._journey.teller.fault(fault)

    def _end(self) -> None:
        self._running = False
        self._show()
        self.changed.emit()

    def _tell(self, told: Sequence[CarpusFault]) -> None:
        for fault in told[:1]:
            self._journey.teller.fault(fault)

    def _show(self) -> None:
        folder = self._library.folder
        has_key, is_on = keys.has_key(folder), keys.is_on(folder)
        self.card.show_state(is_on=is_on, is_ending=has_key and not is_on)


class AskPin:
    """A window that shows nothing but the lock, before the data folder is opened."""

    def __init__(self, theme: Theme, folder: Path) -> None:
        self._folder, self._pin = folder, Pin(folder)
        self.opened = False
        self.shell = Shell(theme)
        self.shell.bar.hide()
        self.sheet = LockSheet(self.shell, theme)
        self.sheet.tried.connect(self._try)
        self._loop = QEventLoop()
        self.shell.closing.connect(self._loop.quit)

    def ask(self) -> bool:
        """Whether the PIN was typed; False where the window was closed."""
        self.sheet.begin_encrypted()
        self.shell.show()
        self._loop.exec()
        self.shell.hide()
        self.shell.deleteLater()
        return self.opened

    def _try(self, typed: str) -> None:
        tried = None
        try:
            tried = self._pin.try_it(typed) if self._pin.is_set else None
            if tried is not None and tried.pause_s and not tried.left and not keys.opens(self._folder, typed):
                self.sheet.refuse(0, round(tried.pause_s))
                return
            keys.unlock(self._folder, typed)
        except KeyRefused:
            self.sheet.refuse(tried.left if tried else 1, 0)
            return
        except CarpusFault:
            self.sheet.refuse(0, 60)
            return
        if tried is not None and not tried.opened and not keys.is_code(self._folder, typed):
            with suppress(CarpusFault, ValueError):  # the program ended between the key's PIN and the lock's
                self._pin.set(typed)
        self.opened = True
        self._loop.quit()
