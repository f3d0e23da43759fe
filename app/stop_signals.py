"""What asks the program to stop: Ctrl+C, a shutdown, a closed terminal."""

from __future__ import annotations

import signal
from collections.abc import Callable

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")


def on_stop(action: Callable[[], object]) -> None:
    """From now on whatever asks to stop makes ``action`` happen.

    What the program was told to ignore by whoever started it (nohup, a job in the background) it goes on ignoring.
    """
    for name in _NAMES:
        number = getattr(signal, name, None)  # Windows knows no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: action())
