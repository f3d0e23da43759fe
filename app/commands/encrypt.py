"""``carpus encrypt``: the data folder encrypted at rest, or plain again."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from carpus.app.asking_pin import NoPin, new_pin
from carpus.app.commands.kept import initials
from carpus.app.commands.progress import bar, tell
from carpus.app.settings import load_sound_settings
from carpus.core.encryption import keys
from carpus.core.errors import CarpusFault, FolderMissing
from carpus.core.library.library import Library
from carpus.core.safekeeping.encryption import check_alone, encrypted_share
from carpus.core.safekeeping.pin import Pin


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="patients and sessions (default: your own)")
    parser.add_argument("--off", action="store_true", help="make everything plain again")
    parser.add_argument("--state", action="store_true", help="only say how it stands")


def run(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.data_folder or load_sound_settings()[0].data_folder
    if not folder.is_dir():
        raise FolderMissing(folder)
    if arguments.state:
        here, there = encrypted_share(folder)
        print(f"{here} of {there} files are encrypted{'; new ones will be' if keys.is_on(folder) else ''}: {folder}")
        return 0
    if keys.is_on(folder) != arguments.off:
        print(f"Nothing to do: {folder} is {'not ' if arguments.off else ''}encrypted.")
        return 0
    if arguments.off:
        return _off(folder)
    check_alone(folder)
    try:
        pin = new_pin(keys.LEAST_SIGNS)
    except NoPin as why:
        print(f"carpus: {why}")
        return 1
    library = _library(folder)
    try:
        with bar("encrypting", "byte") as progress:
            done = library.encrypt(pin, progress)
        Pin(folder).set(pin)
    finally:
        library.close()
    _tell_all(done.told)
    print(f"Encrypted: {folder}")
    print(f"Recovery code: {done.code}")
    print("Write it down and keep it away from this computer. Without the PIN and without it all is lost.")
    print("Back-ups made before are readable still, and so is what a disk keeps of the plain files that were here.")
    return 1 if done.told else 0


def _off(folder: Path) -> int:
    keys.key_for(folder / keys.KEY_FILES[0])
    library = _library(folder)
    try:
        with bar("decrypting", "byte") as progress:
            told = library.decrypt(progress)
    finally:
        library.close()
    _tell_all(told)
    if not keys.has_key(folder):
        print(f"No longer encrypted: {folder}")
    return 1 if told else 0


def _library(folder: Path) -> Library:
    library = Library(folder, by="command")
    library.who = initials
    library.log_fault = tell
    return library


def _tell_all(told: Sequence[CarpusFault]) -> None:
    for fault in told:
        tell(fault)
