"""The desktop application: ``carpus`` without a command, and ``carpus demo``."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import say, tell
from carpus.app.of_file import note_in
from carpus.app.settings import load_sound_settings, note_data_folder
from carpus.core.durable import make_private
from carpus.core.errors import CarpusFault, DataFolderChanged, FolderInUse
from carpus.core.records.restoring import drop_unfinished, is_restored, put_in_place
from carpus.core.records.set_up import PRACTICE_PATIENT


def has_display() -> bool:
    """Whether a window can be seen here."""
    if os.environ.get("QT_QPA_PLATFORM"):
        return os.environ["QT_QPA_PLATFORM"] not in ("offscreen", "minimal")
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def run(arguments: argparse.Namespace) -> int:
    """Open the window and stay until it is closed."""
    return open_window(getattr(arguments, "data_folder", None), is_demo=False)


def open_window(data_folder: Path | None, *, is_demo: bool, session: Path | None = None) -> int:
    """The window, on the real world or on the simulated camera; ``session`` is opened in it, or in the one there is."""
    if not has_display():
        say("there is no display here; “carpus demo” shows the whole way without one.")
        return 1
    gc.disable()  # what is built by a start stays: the collector would look through it again and again, for nothing
    from carpus.app import compose
    from carpus.app.desktop.alone import Alone

    compose.write_log()
    loaded, told = load_sound_settings()
    settings = compose.with_data_folder(loaded, data_folder)
    qt = compose.application(["carpus"])
    alone = Alone(settings.data_folder)
    desktop: compose.Desktop | None = None
    while desktop is None:
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
            before = loaded.data_folder if settings.run_folder is not None else None
            if before is None and not is_demo:
                before = note_data_folder(settings.data_folder)
            other = [] if before is None else [DataFolderChanged(settings.data_folder, str(before))]
            desktop = compose.compose(qt, settings, is_demo=is_demo, told=[*other, *told])
        except CarpusFault as fault:
            alone.let_go()
            tell(fault)
            chosen = compose.ask_for_folder(qt, settings, fault)
            if chosen is None:
                return 1
            settings = compose.with_kept_folder(settings, chosen)
            alone = Alone(settings.data_folder)
    alone.listen(desktop.called)
    compose.speak_in_the_window(desktop)
    compose.end_on_signals(desktop)
    try:
        desktop.show()
        if is_demo and not desktop.closed:
            desktop.journey.patients.screen.refresh(PRACTICE_PATIENT)
        if session is not None and not desktop.closed:
            desktop.open_session(session)
        return 0 if desktop.closed else qt.exec()
    except CarpusFault:
        # A signal may close the window while it is still coming up: what then finds the list closed is no fault.
        if not desktop.closed:
            raise
        return 0
    finally:
        desktop.close()
        alone.let_go()
        if desktop.safe.backing_up.restored:
            _take_restored(settings.data_folder)


def _take_restored(folder: Path) -> None:
    put_in_place(folder, datetime.now())
    note_in(folder, "restored", "everything")
