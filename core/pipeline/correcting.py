"""The owner's end of the correcting process: starts it, hears how far it is, ends it."""

from __future__ import annotations

import multiprocessing
import threading
from collections.abc import Callable

from carpus.core import errors
from carpus.core.errors import CarpusFault, NotCorrected
from carpus.core.phrase import phrase
from carpus.core.pipeline.correcting_process import run
from carpus.core.pipeline.correction import CorrectionTask

LOOK_EVERY_S = 0.2
KILLED_S = 2.0


def correct_beside(task: CorrectionTask, progress: Callable[[int, int], None], stopping: threading.Event) -> bool:
    """Carry a task out in a process of its own and wait for it: whether it was done; False if ``stopping`` came first.

    Raises what went wrong there; :class:`NotCorrected` where the process died.
    """
    context = multiprocessing.get_context("spawn")
    link, theirs = context.Pipe()
    process = context.Process(target=run, args=(theirs,), name="carpus-correcting", daemon=True)
    try:
        process.start()
        theirs.close()
        link.send(task)
        while not stopping.is_set():
            if not link.poll(LOOK_EVERY_S):
                continue
            said, *rest = link.recv()
            if said == "at":
                progress(rest[0], rest[1])
            elif said == "done":
                return True
            else:
                raise _fault(*rest)
        return False
    except (EOFError, BrokenPipeError, ConnectionResetError):
        raise NotCorrected(task.output.name, phrase("its process ended")) from None
    finally:
        link.close()
        process.kill()
        process.join(KILLED_S)
        _clear(task)


def _fault(kind: str, subject: str, detail: str) -> CarpusFault:
    known = getattr(errors, kind, None)
    if isinstance(known, type) and issubclass(known, CarpusFault):
        return known(subject, detail)
    return NotCorrected(subject, f"{kind}: {detail}")


def _clear(task: CorrectionTask) -> None:
    """A process that was killed leaves a part behind: the session it was made from is still there."""
    for path in task.output.parent.glob(f"{task.output.stem}.*"):
        if path != task.output:
            path.unlink(missing_ok=True)
