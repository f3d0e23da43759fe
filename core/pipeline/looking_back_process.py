"""The looking-back process: looks back at a running session beside the process that tracks it.

There it would hold the interpreter's lock, and frames would be lost. It answers every message, in order, and ends
with its owner. This module loads no NumPy before its threads are settled.
"""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from multiprocessing.connection import Connection

NICER = 10
"""Whoever tracks, draws and stores comes first."""
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def run(link: Connection) -> None:
    """Entry of the process. It is sent the hand, then lists of steps as often as wanted, then None. After each list it
    answers with the pieces that came due (often none), after None with the rest; a text in their place says why it
    cannot go on."""
    # an interrupt from the keyboard reaches both processes; the owner decides what it means
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in BLAS_THREADS:
        os.environ.setdefault(name, "1")
    if hasattr(os, "nice"):
        os.nice(NICER)
    try:
        _serve(link)
    except Exception as cause:  # the one catch of this process: told, not printed
        with suppress(OSError):  # the owner may be gone, which may be the cause
            link.send(f"{type(cause).__name__}: {cause}")


def _serve(link: Connection) -> None:
    from carpus.core.pipeline.pieces import PieceByPiece

    pieces = PieceByPiece(*link.recv())
    while (frames := link.recv()) is not None:
        link.send([piece for kept in frames for piece in pieces.take(kept)])
    link.send(pieces.rest())
