"""The desktop application: ``carpus`` without a command, and ``carpus demo``."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from app.settings import load_settings
from core.errors import CarpusFault, FolderInUse
from core.session.database import make_private
from core.words import one_sentence


def has_display() -> bool:
    """Whether a window can be seen here."""
    if os.environ.get("QT_QPA_PLATFORM"):
        return os.environ["QT_QPA_PLATFORM"] not in ("offscreen", "minimal")
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def run(arguments: argparse.Namespace) -> int:
    """Open the window and stay until it is closed."""
    return open_window(getattr(arguments, "data_folder", None), is_demo=False)


def open_window(data_folder: Path | None, *, is_demo: bool) -> int:
    """The window, on the real world or on the simulated camera."""
    if not has_display():
        print("carpus: there is no display here; “carpus demo” shows the whole way without one.", file=sys.stderr)
        return 1
    from app import compose
    from app.desktop.alone import Alone

    compose.write_log()
    settings = compose.with_data_folder(load_settings(), data_folder)
    qt = compose.application(["carpus"])
    alone = Alone(settings.data_folder)
    while True:
        try:
            make_private(settings.data_folder)
            if not alone.take():
                if alone.call_first():
                    print("carpus: it is open already, and has come to the front.", file=sys.stderr)
                    return 0
                raise FolderInUse(settings.data_folder)
            desktop = compose.compose(qt, settings, is_demo=is_demo)
            break
        except CarpusFault as fault:
            alone.let_go()
            print(f"carpus: {one_sentence(fault)}", file=sys.stderr)
            chosen = compose.ask_for_folder(qt, settings, fault)
            if chosen is None:
                return 1
            settings = compose.with_kept_folder(settings, chosen)
            alone = Alone(settings.data_folder)
    alone.listen(desktop.come_to_front)
    compose.speak_in_the_window(desktop)
    compose.end_on_signals(desktop)
    desktop.show()
    if is_demo:
        desktop.journey.prepare_practice()
    try:
        return qt.exec()
    finally:
        desktop.close()
        alone.let_go()
