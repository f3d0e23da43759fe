"""``carpus demo``: the desktop with a simulated camera and patient; unattended without a display."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import progress_bar
from carpus.app.commands import desktop
from carpus.app.settings import load_settings, with_data_folder
from carpus.core.platform.durable import make_private_folder

EXAMPLE = "carpus demo --data-folder out/practice"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="data folder to use (default: your own)")
    parser.add_argument(
        "--unattended", action="store_true", help="run through all screens automatically, without a display"
    )


def run(arguments: argparse.Namespace) -> int:
    if desktop.has_display() and not arguments.unattended:
        return desktop.open_window(arguments.data_folder, is_demo=True)
    from carpus.app.demo_driver import run_demo
    from carpus.app.desktop.log import start_log

    start_log()
    settings = with_data_folder(load_settings(), arguments.data_folder)
    make_private_folder(settings.data_folder)
    with progress_bar("the whole way", "repetition") as progress:
        result = run_demo(settings, progress)
    print(f"Session: {result.session}")
    print(f"Report:  {result.report}")
    for line in result.lines:
        print(line)
    return 0
