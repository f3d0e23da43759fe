"""Work that ends its own process, importable by the processes of a pool."""

from __future__ import annotations

import os
import signal
import time

from carpus.app.batch.tracking_task import TrackingOutcome, TrackingTask, fault_outcome


def deadly(task: TrackingTask) -> TrackingOutcome:
    """``dies`` always kills its process, ``once`` the first time; ``waits`` until it is told to stop; ``hangs`` deaf to
    that, with half a session beside it; ``stutters`` succeeds the second time, ``refuses`` never."""
    mark = task.tracking_input.session
    if task.subject_id == "dies" or (task.subject_id == "once" and not mark.exists()):
        mark.touch()
        time.sleep(0.2)  # long enough for others to be under way
        os.kill(os.getpid(), signal.SIGKILL)
    if task.subject_id == "waits":
        mark.touch()
        try:
            time.sleep(60.0)
        except KeyboardInterrupt:
            mark.unlink()
            raise
    if task.subject_id == "hangs":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        mark.with_name(f".{mark.name}.0123abcd.tmp").write_bytes(b"half")
        time.sleep(60.0)
    if task.subject_id in ("stutters", "refuses"):
        tries = mark.with_suffix(".tries")
        tries.write_text(tries.read_text() + "x" if tries.exists() else "x")
        if task.subject_id == "refuses" or len(tries.read_text()) < 2:
            return fault_outcome(task.tracking_input, "refused", is_retryable=task.subject_id == "stutters")
    return TrackingOutcome(task.tracking_input, "tracked")
