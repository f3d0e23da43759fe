"""``carpus doctor``: what this computer lacks, with a remedy for each."""

from __future__ import annotations

import argparse
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path

from carpus.app.settings import Settings, load_settings
from carpus.core.capture.doctor import examine
from carpus.core.check_card.ages import camera_ages
from carpus.core.errors import CarpusFault
from carpus.core.words import one_sentence

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
    folder = arguments.data_folder or settings.data_folder
    for finding in chain(examine(folder), camera_ages(folder, datetime.now(UTC))):
        print(f"{_MARK[finding.state]}  {finding.name}: {finding.found}")
        if finding.remedy:
            print(f"         {finding.remedy}")
        worst = max(worst, finding.state == "bad")
    return worst
