"""``carpus audit``: the log of what was done with patients' data, and whether it is whole."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from carpus.app.settings import load_sound_settings
from carpus.core.errors import FolderMissing
from carpus.core.safekeeping.audit import read_audit
from carpus.core.safekeeping.backup import log_was_cut


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="patients and sessions (default: your own)")


def run(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.data_folder or load_sound_settings()[0].data_folder
    if not folder.is_dir():
        raise FolderMissing(folder)
    reading = read_audit(folder)
    for entry in reading.entries:
        facts = " ".join(f"{name}={value}" for name, value in entry.facts.items())
        when = entry.when.astimezone().isoformat(timespec="seconds")
        who = entry.who or "-"
        first = f"{entry.number:6d}  {when}  {who:12}  {entry.by:7}  {entry.did:15}"
        print(f"{first} {entry.kind} {entry.identity} {facts}".rstrip())
    for line in reading.torn:
        print(f"carpus: line {line} ends in the middle, as after a power cut.", file=sys.stderr)
    if not reading.is_whole:
        lines = ", ".join(map(str, reading.breaks[:5]))
        print(f"carpus: the log was changed at or before line {lines} of {folder}.", file=sys.stderr)
        return 1
    if log_was_cut(folder, reading):
        print("carpus: lines that the last back-up knew are no more in the log.", file=sys.stderr)
        return 1
    print(f"{len(reading.entries)} lines, whole.")
    return 0
