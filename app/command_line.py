"""What the options of every command have in common: how wrong usage is told, how values are read, how a passphrase is
asked for."""

from __future__ import annotations

import argparse
import getpass
import math
import sys
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from carpus.core.capture.devices.cameras import CAMERAS, check_address
from carpus.core.errors import CameraUnknown, PassphraseUnfit
from carpus.core.names import known_names, nearest
from carpus.core.phrase import phrase


class CommandParser(argparse.ArgumentParser):
    """Tells wrong usage in one line and ends in 2; an unknown name or option comes with what was probably meant."""

    def __init__(self, *args: Any, **options: Any) -> None:
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **options)

    def error(self, message: str) -> NoReturn:
        """End with one line on stderr."""
        said = " ".join(message.removeprefix("argument ").split()).rstrip(".")
        self.exit(2, f"{self.prog}: {said}. “{self.prog} --help” shows how.\n")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            names = [str(name) for name in action.choices]
            raise argparse.ArgumentError(action, f"no “{value}” is known; {known_names(str(value), names)}")

    def refuse(self, extra: Sequence[str]) -> NoReturn:
        """End because of words that no option asked for."""
        word = extra[0]
        meant = nearest(word.partition("=")[0], self._option_string_actions) if word.startswith("-") else None
        also = f"; did you mean “{meant}”?" if meant else ""
        self.error(f"nothing here is called “{word}”{also}")


def number(low: float = -math.inf, high: float = math.inf, unit: str = "") -> Callable[[str], float]:
    """Reads a number from ``low`` to ``high``; anything else is wrong usage."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            between = f" from {low:g} to {high:g}" if math.isfinite(high) else ""
            raise argparse.ArgumentTypeError(f"“{text}” is no number{between}{unit and f' {unit}'}")
        return value

    return read


def count(low: int, high: int) -> Callable[[str], int]:
    """Reads a whole number from ``low`` to ``high``; anything else is wrong usage."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"“{text}” is no whole number from {low} to {high}")
        return value

    return read


def camera_address(text: str) -> str:
    """``KIND`` or ``KIND:WHICH`` of a live camera; an unknown kind is wrong usage."""
    try:
        check_address(text)
    except CameraUnknown as fault:
        raise argparse.ArgumentTypeError(f"no kind of camera is called “{text}”; {fault.detail}") from None
    return text


CAMERA_HELP = f"KIND is {', '.join(CAMERAS)}; WHICH its serial number, or OpenNI2's address"


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
