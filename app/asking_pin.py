"""The PIN of an encrypted data folder, on the command line: from ``CARPUS_PIN``, or typed without being shown."""

from __future__ import annotations

import getpass
import os
import sys
from pathlib import Path

from carpus.core.encryption.keys import PIN_VARIABLE as VARIABLE


class NoPin(ValueError):
    """Why there is none: one sentence."""


def ask_pin(folder: Path) -> str | None:
    """For what is to be read; None where nobody is there to type it."""
    if VARIABLE in os.environ:
        return os.environ[VARIABLE]
    if not sys.stdin.isatty():
        return None
    return getpass.getpass(f"PIN of {folder}: ")


def new_pin(least: int) -> str:
    """For a folder that is to be encrypted, typed twice. Raises :class:`NoPin`."""
    pin = os.environ.get(VARIABLE)
    if pin is None:
        if not sys.stdin.isatty():
            raise NoPin(f"there is nobody to type the PIN: set {VARIABLE} to it.")
        pin = getpass.getpass(f"PIN, {least} signs or more: ")
        if pin != getpass.getpass("The same again: "):
            raise NoPin("the two are not the same; nothing has been changed.")
    if not least <= len(pin) <= 64:
        raise NoPin(f"a PIN that encrypts has {least} to 64 signs, best four words; nothing has been changed.")
    return pin
