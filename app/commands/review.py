"""``carpus review FILE``, or ``carpus FILE.h5``: opens the desktop with one session."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.commands import desktop
from carpus.core.model.errors import SessionMissing

EXAMPLE = "carpus review session.h5"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("session", type=Path, metavar="SESSION.h5", help="session file")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="data folder to use (default: your own)")


def run(arguments: argparse.Namespace) -> int:
    path = arguments.session.absolute()
    if not path.is_file():  # whatever else is wrong with it, the window tells
        raise SessionMissing(arguments.session)
    return desktop.open_window(arguments.data_folder, is_demo=False, file=path)
