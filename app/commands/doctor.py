"""``carpus doctor``: what this computer lacks, with a remedy for each."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.settings import Settings, load_settings
from core.capture.doctor import examine
from core.errors import CarpusFault
from core.words import one_sentence

_MARK = {"good": "ok     ", "warning": "look   ", "bad": "missing"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="instead of the one in the settings")


def run(arguments: argparse.Namespace) -> int:
    worst, settings = 0, Settings()
    try:
        settings = load_settings()
    except CarpusFault as fault:
        print(f"{_MARK['bad']}  Settings: {one_sentence(fault)}")
        worst = 1
    for finding in examine(arguments.data_folder or settings.data_folder):
        print(f"{_MARK[finding.state]}  {finding.name}: {finding.found}")
        if finding.remedy:
            print(f"         {finding.remedy}")
        worst = max(worst, finding.state == "bad")
    return worst
