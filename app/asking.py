"""A passphrase on the command line: typed without being shown, or the first line of what comes in; never an argument,
which every user of the computer could read, nor of the environment, which every child inherits."""

from __future__ import annotations

import getpass
import sys

from carpus.core.errors import PassphraseUnfit
from carpus.core.phrase import phrase


def ask_passphrase(*, least_signs: int = 0) -> str:
    """For what is to be opened; with ``least_signs`` for what is to be sealed, typed twice. Raises
    :class:`PassphraseUnfit`."""
    if not sys.stdin.isatty():
        typed = sys.stdin.readline().rstrip("\r\n")
    else:
        typed = getpass.getpass("Passphrase: ")
        if least_signs and typed != getpass.getpass("The same again: "):
            raise PassphraseUnfit("", phrase("the two are not the same"))
    if len(typed) < max(least_signs, 1):
        raise PassphraseUnfit("", phrase("too few signs"))
    return typed
