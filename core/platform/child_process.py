"""Child processes: started, set up and ended in one way.

What may crash, hang, grow without bound or hold the interpreter's lock runs in a child process: a camera's driver, HDF5
on files of unknown origin, smoothing, tracking of stored sessions. The work is named ``"module:function"`` and imported
in the child, after its threads and signals are set up. This module does not load NumPy.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import threading
import time
import types
from collections.abc import Callable
from importlib import import_module
from multiprocessing.connection import Connection
from typing import Any

BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
NICENESS = 5
"""Tracking, drawing and writing come first, until they wait for the child."""
CLEANUP_S = 7.5
"""Time that a child whose owner is gone may take to clean up."""
KILL_TIMEOUT_S = 3.0
"""The system ends a killed process within this time, unless a disk or a device holds it."""
_STARTING = threading.Lock()


class ChildDiedError(Exception):
    """Raised when the child ended, or was ended, before it answered."""


class ChildProcess:
    """A function in a process of its own, and the owner's end of the pipe to it.

    Raises :class:`OSError` if the system cannot start a process. A child that is no longer referenced is ended; it
    notices that, and its owner's death, by the end of its pipe.

    Parameters
    ----------
    work
        A function of a module, or its name as ``"module:function"`` if the owner need not load it. Called with the
        child's end of the pipe and then the arguments.
    arguments
        Values that can be pickled.
    name
        Name of the process, after ``carpus-``.
    is_forked
        Copy this process instead of starting an interpreter. Only if no thread, window or open HDF5 file would be
        copied.
    """

    def __init__(
        self, work: str | Callable[..., object], *arguments: object, name: str, is_forked: bool = False
    ) -> None:
        self.link, theirs = multiprocessing.Pipe()
        if not isinstance(work, str):
            work = f"{work.__module__}:{work.__qualname__}"
        context: Any = multiprocessing.get_context("fork" if is_forked else "spawn")
        packed = pickle.dumps(arguments)
        self._process = context.Process(
            target=_run_child, args=(theirs, work, packed, is_forked), name=f"carpus-{name}", daemon=True
        )
        try:
            with _STARTING:
                own: Any = multiprocessing.current_process()
                is_daemon, main = own.daemon, sys.modules["__main__"]
                try:
                    if is_daemon:  # a worker of Dask or of a pool; its child does not outlive it
                        own.daemon = False
                    # a child would run the main script again, for which researchers' scripts are not made
                    sys.modules["__main__"] = types.ModuleType("__main__")
                    self._process.start()
                finally:
                    sys.modules["__main__"] = main
                    if is_daemon:
                        own.daemon = True
        except BaseException:
            self.link.close()
            raise
        finally:
            theirs.close()

    @property
    def pid(self) -> int:
        pid: int = self._process.pid
        return pid

    @property
    def is_alive(self) -> bool:
        return bool(self._process.is_alive())

    def terminate(self) -> None:
        """Ask the process to end (SIGTERM), without waiting."""
        self._process.terminate()

    def kill(self, grace_s: float = 0.0) -> None:
        """Kill the process after ``grace_s``; from any thread, any number of times."""
        self._process.join(grace_s)
        self._process.kill()
        self._process.join(KILL_TIMEOUT_S)

    def end(self, grace_s: float = 0.0) -> None:
        self.kill(grace_s)
        self.link.close()

    def describe_exit(self, patience_s: float = KILL_TIMEOUT_S) -> str:
        self._process.join(patience_s)
        code = self._process.exitcode
        if code is None or code >= 0:
            return f"its process ended with {code}"
        return f"its process died of {signal.Signals(-code).name}"


def call_in_child(function: Callable[..., Any], *arguments: object, limit_s: float = 60.0) -> Any:
    """Return what a function returns in a process of its own.

    Raises
    ------
    ChildDied
        The process ended, or did not answer in time.
    Exception
        What the function raised.
    """
    child = ChildProcess(_send_result, function, arguments, name="call")
    try:
        if not child.link.poll(limit_s):
            raise ChildDiedError(f"no answer for {limit_s:g} s")
        value, fault = child.link.recv()
    except (EOFError, OSError):
        raise ChildDiedError(child.describe_exit()) from None
    finally:
        child.end()
    if fault is not None:
        raise fault
    return value


# --- in the child -------------------------------------------------------------------------------------------------
def _run_child(link: Connection, work: str, arguments: bytes, is_forked: bool) -> None:
    if is_forked:
        _STARTING.release()  # the copy was made while the owner held it
        # close all files that a fork would hold open, the owner's end of the pipe above all
        parent = multiprocessing.parent_process()
        assert parent is not None
        kept = sorted((2, link.fileno(), parent.sentinel))
        for low, high in zip(kept, [*kept[1:], 4096], strict=True):
            os.closerange(low + 1, high)
    for number in signal.valid_signals():
        if callable(signal.getsignal(number)):
            signal.signal(number, signal.SIG_DFL)
    # an interrupt from the keyboard reaches owner and child; the owner decides what it means
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in BLAS_THREADS:
        os.environ.setdefault(name, "1")
    module, _, function = work.partition(":")
    getattr(import_module(module), function)(link, *pickle.loads(arguments))
    if is_forked:
        os._exit(0)  # what the owner registered for its own end is not the copy's


def _send_result(link: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    try:
        link.send((function(*arguments), None))
    except Exception as fault:  # sent to the owner, not printed
        link.send((None, fault))


def end_with_owner() -> None:
    """End this process when its owner is gone, even from within a call that does not return.

    SIGTERM comes first, which the work may handle to clean up, and after :data:`CLEANUP_S` an exit in any case.
    """
    threading.Thread(target=_end_after_owner, name="owner", daemon=True).start()


def _end_after_owner() -> None:
    owner = multiprocessing.parent_process()
    assert owner is not None
    owner.join()
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(CLEANUP_S)
    os._exit(1)


def lower_priority() -> None:
    """Give the owner priority; under Linux only this thread gives way."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
