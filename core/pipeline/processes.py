"""What runs in processes of their own: looking back at a running session, and tracking a stored one again.

In the process that tracks, draws and stores either would hold the interpreter's lock, and frames would be lost. Both
end with their owner. This module loads no NumPy before their threads are settled.
"""

from __future__ import annotations

import os
import signal
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from carpus.core.pipeline.looking_back import PieceByPiece

NICER = 5
"""Whoever tracks, draws and stores comes first, three times, until they wait for this one."""
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
TELL_EVERY = 15
"""Frames."""


def look_back(link: Connection) -> None:
    """Entry of a process. It is sent the hand, then lists of steps as often as wanted while a recording runs, then
    None, then those that are left, then None. After each list it answers with the pieces that came due (often none),
    after the last None with the rest; a text in their place says why it cannot go on."""
    _settle()
    try:
        from carpus.core.pipeline.looking_back import PieceByPiece

        pieces = PieceByPiece(*link.recv())
        with ThreadPoolExecutor(1) as meanwhile:
            meanwhile.submit(_take, link, pieces, NICER).result()
        _take(link, pieces)  # somebody waits now: this thread gives way to nobody
        link.send(pieces.rest())
    except Exception as cause:  # the one catch of this process: told, not printed
        with suppress(OSError):  # the owner may be gone, which may be the cause
            link.send(f"{type(cause).__name__}: {cause}")


def _take(link: Connection, pieces: PieceByPiece, nicer: int = 0) -> None:
    """Answer lists of steps until None comes."""
    _give_way(nicer)  # under Linux this thread alone
    for frames in iter(link.recv, None):
        link.send([piece for kept in frames for piece in pieces.take(kept)])


def track_again(link: Connection) -> None:
    """Entry of a process. It is sent a task; it sends ``("at", done, total)``, at last ``("done", ...)`` or ``("fault",
    kind, subject, detail)``."""
    _settle()
    _give_way(NICER)

    def tell(done: int, total: int | None) -> None:
        if done % TELL_EVERY == 0:
            link.send(("at", done, total or 0))

    try:
        from carpus.core.pipeline.correction import correct

        correct(link.recv(), tell)
        link.send(("done", "", "", ""))
    except Exception as cause:  # the one catch of this process: told, not printed
        subject, detail = getattr(cause, "subject", ""), getattr(cause, "detail", str(cause))
        with suppress(OSError):  # the owner may be gone, which may be the cause
            link.send(("fault", type(cause).__name__, subject, detail))


def _settle() -> None:
    # an interrupt from the keyboard reaches owner and process; the owner decides what it means
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in BLAS_THREADS:
        os.environ.setdefault(name, "1")


def _give_way(nicer: int) -> None:
    if hasattr(os, "nice"):
        os.nice(nicer)
