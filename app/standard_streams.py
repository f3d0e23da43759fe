"""Standard output and error as commands need them: there, and told of where they cannot be written."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress
from typing import TextIO


def open_closed() -> None:
    """A stream closed by whoever started us would give its number to the next file, and messages would go there."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = (stream or io.StringIO() for stream in (sys.stdin, sys.stdout, sys.stderr))


def flushed(stream: TextIO) -> OSError | None:
    """Write out what ``stream`` still holds; returns why that is impossible.

    What it holds then goes nowhere: the interpreter would try again at its end, and end in 120.
    """
    try:
        stream.flush()
    except OSError as cause:
        with suppress(OSError):  # a stream that is no file
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)
        return cause
    return None


def say(sentence: str) -> None:
    """One line on standard error, where that can be written."""
    with suppress(OSError):
        print(f"carpus: {sentence}", file=sys.stderr)
    flushed(sys.stderr)
