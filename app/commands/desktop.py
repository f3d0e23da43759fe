"""The desktop application: ``carpus`` without a command, and ``carpus demo``."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import say, tell
from carpus.app.of_file import note_in
from carpus.app.settings import Settings, load_sound_settings, note_data_folder, with_data_folder, with_kept_folder
from carpus.core.durable import make_private
from carpus.core.errors import CarpusFault, DataFolderChanged, FolderInUse
from carpus.core.records.reserve import keep_reserve
from carpus.core.records.set_up import PRACTICE_PATIENT

if TYPE_CHECKING:  # nothing of Qt without a display
    from PySide6.QtWidgets import QApplication

    from carpus.app.desktop.alone import Alone
    from carpus.app.desktop.window import Desktop


def has_display() -> bool:
    """Whether a window can be seen here."""
    if os.environ.get("QT_QPA_PLATFORM"):
        return os.environ["QT_QPA_PLATFORM"] not in ("offscreen", "minimal")
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def run(arguments: argparse.Namespace) -> int:
    """Open the window and stay until it is closed."""
    return open_window(getattr(arguments, "data_folder", None), is_demo=False)


def open_window(data_folder: Path | None, *, is_demo: bool, session: Path | None = None) -> int:
    """The window, on the real world or on the simulated camera; ``session`` is opened in it, or in the one there is.
    Opened again, with the settings as they are then, once a language was chosen."""
    if not has_display():
        say("there is no display here; “carpus demo” shows the whole way without one.")
        return 1
    gc.disable()  # what is built by a start stays: the collector would look through it again and again, for nothing
    from carpus.app.desktop import log, looks

    log.write_log()
    loaded, told = load_sound_settings()
    settings = with_data_folder(loaded, data_folder)
    qt = looks.application(["carpus"])
    usual = loaded.data_folder if loaded.data_folder.is_dir() else None
    is_reopened = False
    while True:
        opened = _opened(qt, settings, is_demo=is_demo, usual=usual, session=session, told=told)
        if isinstance(opened, int):
            return opened
        desktop, alone = opened
        try:
            code = _run(desktop, session, is_demo=is_demo, is_reopened=is_reopened)
        finally:
            desktop.close()
            alone.let_go()
            if desktop.safe.backing_up.restored:
                _take_restored(desktop.library.folder)
        if not desktop.is_to_reopen:
            return code
        settings, told, usual, session, is_reopened = desktop.keeper.settings, [], None, None, True
        del desktop, opened
        _forget_windows(qt)


def _opened(
    qt: QApplication,
    settings: Settings,
    *,
    is_demo: bool,
    usual: Path | None,
    session: Path | None,
    told: Sequence[CarpusFault],
) -> tuple[Desktop, Alone] | int:
    """The window put together, on another folder where a person chose one; or the exit code where there is none.
    ``usual`` is the folder that one named for this start stands in for; None where there is nothing to be told."""
    from carpus.app import compose
    from carpus.app.desktop import no_folder
    from carpus.app.desktop.alone import Alone
    from carpus.app.desktop.log import speak_in_the_window
    from carpus.app.desktop.window import end_on_signals
    from carpus.core.records.restoring import drop_unfinished, is_restored

    while True:
        alone = Alone(settings.data_folder)
        try:
            make_private(settings.data_folder)
            if not alone.take():
                if alone.call_first(session):
                    say("it is open already, and has come to the front.")
                    return 0
                raise FolderInUse(settings.data_folder)
            if is_restored(settings.data_folder):  # its program was killed before it had the name
                alone.let_go()
                _take_restored(settings.data_folder)
                continue
            drop_unfinished(settings.data_folder)
            before = usual
            if settings.run_folder is None:
                before = None if is_demo else note_data_folder(settings.data_folder)
            other = [] if before is None else [DataFolderChanged(settings.data_folder, str(before))]
            desktop = compose.compose(qt, settings, is_demo=is_demo, told=[*other, *told])
            keep_reserve(settings.data_folder)
        except CarpusFault as fault:
            alone.let_go()
            tell(fault)
            chosen = no_folder.ask_for_folder(qt, settings, fault)
            if chosen is None:
                return 1
            settings = with_kept_folder(settings, chosen)
            continue
        alone.listen(desktop.called)
        speak_in_the_window(desktop.journey.messages.fault)
        end_on_signals(desktop)
        return desktop, alone


def _run(desktop: Desktop, session: Path | None, *, is_demo: bool, is_reopened: bool) -> int:
    """Show the window until it is closed."""
    try:
        desktop.show(is_reopened=is_reopened)
        if is_demo and not desktop.closed:
            desktop.journey.patients.screen.refresh(PRACTICE_PATIENT)
        if session is not None and not desktop.closed:
            desktop.open_session(session)
        return 0 if desktop.closed else desktop.application.exec()
    except CarpusFault:
        # A signal may close the window while it is still coming up: what then finds the list closed is no fault.
        if not desktop.closed:
            raise
        return 0


def _take_restored(folder: Path) -> None:
    from carpus.core.records.restoring import put_in_place

    put_in_place(folder, datetime.now())
    note_in(folder, "restored", "everything")


def _forget_windows(qt: QApplication) -> None:
    """Let go of all widgets, also of screens never shown: they would be styled with the new ones."""
    from PySide6.QtCore import QEvent

    gc.unfreeze()
    for widget in qt.topLevelWidgets():
        widget.deleteLater()
    qt.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
    gc.collect()
