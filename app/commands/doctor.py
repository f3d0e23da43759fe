"""``carpus doctor``: what this computer lacks, with a remedy for each."""

from __future__ import annotations

import argparse
from pathlib import Path

import platformdirs

from core.capture.doctor import examine

_MARK = {"good": "ok     ", "warning": "look   ", "bad": "missing"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data-folder", type=Path, default=Path(platformdirs.user_data_dir("carpus", appauthor=False)))


def run(arguments: argparse.Namespace) -> int:
    worst = 0
    for finding in examine(arguments.data_folder):
        print(f"{_MARK[finding.state]}  {finding.name}: {finding.found}")
        if finding.remedy:
            print(f"         {finding.remedy}")
        worst = max(worst, finding.state == "bad")
    return worst
