"""The correcting process: tracks a session again beside the process that measures, draws and stores.

There it would hold the interpreter's lock, and frames of a new measurement would be lost. It is sent a task and answers
with how far it is, at last with what came of it. This module loads no NumPy before its threads are settled.
"""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from multiprocessing.connection import Connection

from carpus.core.pipeline.looking_back_process import BLAS_THREADS, NICER

TELL_EVERY = 15
"""Frames."""


def run(link: Connection) -> None:
    """Entry of the process. Sends ``("at", done, total)``, at last ``("done", ...)`` or ``("fault", kind, subject,
    detail)``."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the owner decides what an interrupt means
    for name in BLAS_THREADS:
        os.environ.setdefault(name, "1")
    if hasattr(os, "nice"):
        os.nice(NICER)
    try:
        _serve(link)
    except Exception as cause:  # the one catch of this process: told, not printed
        subject, detail = getattr(cause, "subject", ""), getattr(cause, "detail", str(cause))
        with suppress(OSError):  # the owner may be gone, which may be the cause
            link.send(("fault", type(cause).__name__, subject, detail))


def _serve(link: Connection) -> None:
    from carpus.core.pipeline.correction import correct

    def tell(done: int, total: int | None) -> None:
        if done % TELL_EVERY == 0:
            link.send(("at", done, total or 0))

    correct(link.recv(), tell)
    link.send(("done", "", "", ""))
