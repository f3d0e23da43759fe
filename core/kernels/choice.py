"""Which kernels run: those in C where they were built for this source and this computer, else NumPy's functions.

``CARPUS_KERNELS=numpy`` forces NumPy's, ``CARPUS_KERNELS=plain`` those in C that every processor runs. A function that
has a kernel asks :func:`in_c` each time it is called.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import _cffi_backend  # cffi without its parser of C, which takes longer to load than all of NumPy
import numpy as np

from carpus.core.kernels.build import HERE, PLAIN, WIDE, digest, levels, library

VARIABLE, NUMPY = "CARPUS_KERNELS", "numpy"

_FFI = _cffi_backend.FFI()
NOTHING = _FFI.NULL
"""Stands for an array that is not given."""
_BUFFERS = {
    np.dtype(number): _FFI.typeof(f"{name}[]")
    for number, name in (
        (np.float64, "double"),
        (np.float32, "float"),
        (np.bool_, "uint8_t"),
        (np.uint8, "uint8_t"),
        (np.uint16, "uint16_t"),
        (np.int32, "int32_t"),
        (np.int64, "int64_t"),
    )
}
_FAULTS = {
    1: np.linalg.LinAlgError("Matrix is not positive definite"),
    2: MemoryError("no memory for a kernel"),
    3: ValueError("a kernel was asked for what lies outside"),
}
"""By what a kernel returns: ``kernels.h``."""
_DECLARED = re.compile(r"^KERNEL int (\w+)\(([^;]*)\);", re.M)
_SIZED = re.compile(r"(\w+)\[([^]]*)\]")
"""An argument that is an array, and how many numbers it has."""


class Kernels:
    """One library. ``level`` says which; every function that its header declares is an attribute, which takes arrays
    and numbers and raises ``numpy.linalg.LinAlgError`` where a matrix is not positive definite, ``MemoryError``,
    ``TypeError`` and ``ValueError`` where an array is not of the type or size declared or too small for what is asked
    of it."""

    def __init__(self, path: Path, level: str) -> None:
        """Raises ``OSError`` where the library cannot be loaded or is of another source."""
        self.level = level
        loaded = _cffi_backend.load_library(str(path), 0)
        try:
            told = loaded.load_function(_FFI.typeof("char *(*)(void)"), "kernels_digest")()
            if _FFI.string(told).decode() != path.name.split("-")[1]:
                raise OSError(f"{path.name} is of another source")
            declared = _DECLARED.findall((HERE / "kernels.h").read_text(encoding="utf-8"))
            for name, arguments in declared:
                pointers = _SIZED.sub(r"*\1", arguments)
                function = loaded.load_function(_FFI.typeof(f"int (*)({pointers})"), name)
                setattr(self, name, _called(function, _sizes(arguments)))
            self._wide = loaded.load_function(_FFI.typeof("int (*)(void)"), "kernels_run_wide")
        except AttributeError as fault:
            raise OSError(str(fault)) from fault
        self._library = loaded  # as long as its functions

    @property
    def processor_is_wide(self) -> bool:
        """Whether this processor runs the wide level."""
        return bool(self._wide())

    def __getattr__(self, name: str) -> Callable[..., None]:
        raise AttributeError(f"no kernel {name}")


def _sizes(arguments: str) -> Callable[..., bool]:
    """Whether the arrays given have the sizes declared; compiled, since it is asked at each call."""
    names = [re.findall(r"\w+", _SIZED.sub(r"\1", one))[-1] for one in arguments.split(",")]
    sizes = [f"({name} is nothing or {name}.size == {size})" for name, size in _SIZED.findall(arguments)]
    asked: Callable[..., bool] = eval(f"lambda {','.join(names)}: {' and '.join(sizes) or True}", {"nothing": NOTHING})
    return asked


def _called(function: Any, are_whole: Callable[..., bool]) -> Callable[..., None]:
    """A function of arrays, each of the type that its header declares, and numbers."""
    of_array, buffers, array, usual = _FFI.from_buffer, _BUFFERS, np.ndarray, np.dtype(np.float64)
    doubles = buffers[usual]

    def as_c(value: Any) -> Any:
        if not isinstance(value, array):
            return value
        native = value.dtype.newbyteorder("=")
        if native not in buffers:
            raise TypeError(f"no kernel takes {native}")
        return of_array(buffers[native], np.ascontiguousarray(value, dtype=native))

    def call(*arguments: Any) -> None:
        if not are_whole(*arguments):
            raise ValueError("an array is not of the size that the kernel reads or writes")
        try:
            status = function(
                *[
                    (of_array(doubles, x) if x.dtype is usual else of_array(buffers[x.dtype], x))
                    if x.__class__ is array
                    else x
                    for x in arguments
                ]
            )
        except (TypeError, ValueError, KeyError, BufferError):  # one that is not there, or not stored row by row
            status = function(*[as_c(x) for x in arguments])
        if status:
            raise _FAULTS[status]

    return call


def _loaded(asked: str) -> Kernels | None:
    if asked == NUMPY:
        return None
    made_of = digest()
    try:
        plain = Kernels(library(PLAIN, made_of), PLAIN)
    except OSError:
        return None
    if asked != PLAIN and WIDE in levels() and plain.processor_is_wide:
        try:
            return Kernels(library(WIDE, made_of), WIDE)
        except OSError:
            return plain
    return plain


_chosen: Kernels | None = _loaded(os.environ.get(VARIABLE, ""))


def in_c() -> Kernels | None:
    """The kernels in C that run here; None where NumPy's functions do."""
    return _chosen


@contextmanager
def forced(asked: str) -> Iterator[Kernels | None]:
    """Other kernels for a while, of this whole process: what the variable can ask for."""
    global _chosen
    before, _chosen = _chosen, _loaded(asked)
    try:
        yield _chosen
    finally:
        _chosen = before
