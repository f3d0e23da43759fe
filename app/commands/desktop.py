"""The desktop application: ``carpus`` without a command, ``carpus demo`` and ``carpus review``."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import add_examples, print_fault, print_message, progress_bar
from carpus.app.session_commands import log_folder_action
from carpus.app.settings import Settings, load_settings, load_valid_settings, with_data_folder, with_saved_folder
from carpus.core.model.errors import CarpusFault, FolderInUse, SessionMissing
from carpus.core.platform.durable import make_private_folder
from carpus.core.records.session_setup import PRACTICE_PATIENT

if TYPE_CHECKING:  # nothing of Qt without a display
    from PySide6.QtWidgets import QApplication, QSplashScreen

    from carpus.app.desktop.single_instance import SingleInstance
    from carpus.app.desktop.window import Desktop


def has_display() -> bool:
    """Tell whether a window can be shown."""
    if os.environ.get("QT_QPA_PLATFORM"):
        return os.environ["QT_QPA_PLATFORM"] not in ("offscreen", "minimal")
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def add_demo_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus demo --data-folder out/practice")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="data folder to use (default: your own)")
    parser.add_argument(
        "--unattended", action="store_true", help="run through all screens automatically, without a display"
    )


def run_demo(arguments: argparse.Namespace) -> int:
    if has_display() and not arguments.unattended:
        return open_window(arguments.data_folder, is_demo=True)
    from carpus.app import demo_driver
    from carpus.app.desktop.log import start_log

    start_log()
    settings = with_data_folder(load_settings(), arguments.data_folder)
    make_private_folder(settings.data_folder)
    with progress_bar("the whole way", "repetition") as progress:
        result = demo_driver.run_demo(settings, progress)
    print(f"Session: {result.session}", f"Report:  {result.report}", *result.lines, sep="\n")
    return 0


def add_review_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus review session.h5")
    parser.add_argument("session", type=Path, metavar="SESSION.h5", help="session file")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="data folder to use (default: your own)")


def run_review(arguments: argparse.Namespace) -> int:
    path = arguments.session.absolute()
    if not path.is_file():  # whatever else is wrong with it, the window tells
        raise SessionMissing(arguments.session)
    return open_window(arguments.data_folder, is_demo=False, file=path)


def open_window(data_folder: Path | None, *, is_demo: bool, file: Path | None = None) -> int:
    """Show the desktop until it is closed, again after a change of language, and return the exit code.

    ``file``, a session or a GDT request, is opened in it, or in the desktop that is open already.
    """
    if not has_display():
        print_message("there is no display here; “carpus demo” shows the whole way without one.")
        return 1
    gc.disable()  # what is built by a start stays: the collector would look through it again and again, for nothing
    from carpus.app.desktop import appearance, log

    log.start_log()
    qt = appearance.create_application(["carpus"])
    splash = appearance.show_splash(qt)
    loaded, told = load_valid_settings()
    settings = with_data_folder(loaded, data_folder)
    is_reopened, are_names_hidden, patient_id = False, False, ""
    while True:
        opened = _open_desktop(qt, splash, settings, is_demo=is_demo, file=file, startup_faults=told)
        if isinstance(opened, int):
            return opened
        desktop, alone = opened
        desktop.controller.context.names.set_hidden(are_names_hidden)
        try:
            code = _run_desktop(desktop, splash, file, is_demo=is_demo, is_reopened=is_reopened, patient_id=patient_id)
            patient_id = desktop.controller.patients.screen.selected_patient_id
            are_names_hidden = desktop.controller.context.names.is_hidden
        finally:
            desktop.close()
            alone.release()
            if desktop.data_protection.backing_up.is_restored:
                _finish_restore(desktop.library.folder)
        if not desktop.must_reopen:
            return code
        settings, told, file, is_reopened = desktop.preferences.settings, [], None, True
        del desktop, opened
        # delete all widgets, also hidden ones: they would be styled together with the new ones
        from PySide6.QtCore import QEvent

        gc.unfreeze()
        for widget in qt.topLevelWidgets():
            if widget is not splash:  # closed by the next desktop too
                widget.deleteLater()
        qt.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        gc.collect()


def _open_desktop(
    qt: QApplication,
    splash: QSplashScreen,
    settings: Settings,
    *,
    is_demo: bool,
    file: Path | None,
    startup_faults: Sequence[CarpusFault],
) -> tuple[Desktop, SingleInstance] | int:
    """Build the desktop, on another data folder if a person chose one; return the exit code if there is none."""
    from carpus.app import compose
    from carpus.app.desktop import folder_window
    from carpus.app.desktop.log import show_uncaught_errors
    from carpus.app.desktop.single_instance import SingleInstance
    from carpus.app.desktop.window import close_on_signals
    from carpus.core.records.restoring import delete_unfinished, has_restored_folder

    while True:
        alone = SingleInstance(settings.data_folder)
        try:
            make_private_folder(settings.data_folder)
            if not alone.acquire():
                if alone.notify_running_instance(file):
                    print_message("it is open already, and has come to the front.")
                    return 0
                raise FolderInUse(settings.data_folder)
            if has_restored_folder(settings.data_folder):  # its program was killed before it had the name
                alone.release()
                _finish_restore(settings.data_folder)
                continue
            delete_unfinished(settings.data_folder)
            desktop = compose.compose(qt, settings, is_demo=is_demo, startup_faults=startup_faults)
        except CarpusFault as fault:
            alone.release()
            print_fault(fault)
            splash.close()
            chosen = folder_window.choose_data_folder(qt, settings, fault)
            if chosen is None:
                return 1
            settings = with_saved_folder(settings, chosen)
            continue
        alone.listen(desktop.on_second_instance)
        show_uncaught_errors(desktop.controller.messages.show_fault)
        close_on_signals(desktop)
        return desktop, alone


def _run_desktop(
    desktop: Desktop, splash: QSplashScreen, file: Path | None, *, is_demo: bool, is_reopened: bool, patient_id: str
) -> int:
    try:
        desktop.show(is_reopened=is_reopened, patient_id=patient_id)
        splash.close()
        if is_demo and not is_reopened and not desktop.is_closed:
            desktop.controller.patients.screen.refresh(PRACTICE_PATIENT)
        if file is not None and not desktop.is_closed:
            desktop.open_file(file)
        return 0 if desktop.is_closed else desktop.application.exec()
    except CarpusFault:
        # A signal may close the window while it is still coming up: what then finds the list closed is no fault.
        if not desktop.is_closed:
            raise
        return 0


def _finish_restore(folder: Path) -> None:
    from carpus.core.records.restoring import activate_restored

    activate_restored(folder, datetime.now())
    log_folder_action(folder, "restored", "everything")
