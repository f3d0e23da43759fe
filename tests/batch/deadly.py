"""Work that ends its own process, importable by the processes of a pool."""

from __future__ import annotations

import os
import signal
import time

from carpus.app.batch.work import Outcome, Task


def deadly(task: Task) -> Outcome:
    """``dies`` always kills its process; ``once`` the first time; ``waits`` until it is told to stop."""
    mark = task.place.session
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
    return Outcome(task.place, "tracked")
