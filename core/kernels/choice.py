"""Which kernels run: those in C where they were built for this source and this computer, else NumPy's functions.

``CARPUS_KERNELS=numpy`` forces NumPy's, ``CARPUS_KERNELS=plain`` those in C that every processor runs. A function that
has a kernel asks :func:`in_c` each time it is called.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import _cffi_backend  # cffi without its parser of C, which takes longer to load than all of NumPy
import numpy as np

from carpus.core.kernels.build import HERE, PLAIN, WIDE, digest, is_whole, levels, library

VARIABLE, NUMPY = "CARPUS_KERNELS", "numpy"
TO_ASK_FOR = (NUMPY, PLAIN)

_FFI = _cffi_backend.FFI()
NOTHING = _FFI.NULL
"""Stands for an array that is not given."""
_C_TYPES = {
    np.dtype(number): name
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
_BUFFERS = {number: _FFI.typeof(f"{name}[]") for number, name in _C_TYPES.items()}
_FAULTS = {
    1: partial(np.linalg.LinAlgError, "Matrix is not positive definite"),
    2: partial(MemoryError, "no memory for a kernel"),
    3: partial(ValueError, "a kernel was asked for what lies outside"),
}
"""By what a kernel returns: ``kernels.h``. A new one each time: one raised again keeps the frames it came through."""
_DECLARED = re.compile(r"^KERNEL int (\w+)\(([^;]*)\);", re.M)
_SIZED = re.compile(r"(\w+)\[([^]]*)\]")
"""An argument that is an array, and how many numbers it has."""
_ARRAY = re.compile(r"(?:const )?(\w+) (?:\*(\w+)|(\w+)\[.*)")
"""An argument that is an array: its type, and its name where its size is not declared, or where it is."""


class Kernels:
    """One library. ``level`` says which; every function that its header declares is an attribute, which takes arrays
    and numbers and raises ``numpy.linalg.LinAlgError`` where a matrix is not positive definite, ``MemoryError``,
    ``TypeError`` and ``ValueError`` where an array is not of the type or size declared or too small for what is asked
    of it."""

    def __init__(self, path: Path, level: str) -> None:
        """Raises ``OSError`` where the library is not whole, cannot be loaded or is of another source."""
        self.level = level
        if not is_whole(path):
            raise OSError(f"{path.name} is not whole")
        loaded = _cffi_backend.load_library(str(path), 0)
        try:
            told = loaded.load_function(_FFI.typeof("char *(*)(void)"), "kernels_digest")()
            if _FFI.string(told).decode() != path.name.split("-")[1]:
                raise OSError(f"{path.name} is of another source")
            self._declared = dict(_DECLARED.findall((HERE / "kernels.h").read_text(encoding="utf-8")))
            self._wide = loaded.load_function(_FFI.typeof("int (*)(void)"), "kernels_run_wide")
        except AttributeError as fault:
            raise OSError(str(fault)) from fault
        self._library = loaded

    @property
    def processor_is_wide(self) -> bool:
        """Whether this processor runs the wide level."""
        return bool(self._wide())

    def __getattr__(self, name: str) -> Callable[..., None]:
        """A kernel, made ready when it is first asked for: all of them take as long as a start of Python."""
        if name not in self._declared:
            raise AttributeError(f"no kernel {name}")
        arguments = self._declared[name]
        pointers = _SIZED.sub(r"*\1", arguments)
        call = _called(self._library.load_function(_FFI.typeof(f"int (*)({pointers})"), name), arguments)
        setattr(self, name, call)
        return call


def _called(function: Any, arguments: str) -> Callable[..., None]:
    """A function of arrays, each of the type and size that its header declares, and numbers.

    Written out for these arguments and compiled: a frame asks thirty times, and a loop over them takes as long again
    as the call.
    """
    names, given, whole = [], [], []
    for one in map(str.strip, arguments.split(",")):
        is_array = _ARRAY.fullmatch(one)
        names.append((is_array[2] or is_array[3]) if is_array else one.split()[-1])
        given.append(names[-1])
        if is_array:
            is_usual = " or ".join(
                f"{names[-1]}.dtype is {dtype.name}" for dtype, name in _C_TYPES.items() if name == is_array[1]
            )
            taken = f"of_array(as_{is_array[1]}, {names[-1]}) if {is_usual} else as_c({names[-1]})"
            given[-1] = f"{names[-1]} if {names[-1]} is nothing else {taken}"
    whole = [f"({name} is nothing or {name}.size == {size})" for name, size in _SIZED.findall(arguments)]
    written = f"""
def call({", ".join(names)}):
    if not ({" and ".join(whole) or True}):
        raise ValueError("an array is not of the size that the kernel reads or writes")
    try:
        status = function({", ".join(given)})
    except (TypeError, ValueError, KeyError, BufferError):  # one that is not stored row by row
        status = function({", ".join(f"as_c({name})" for name in names)})
    if status:
        raise faults[status]()
"""
    types = {f"as_{name}": _BUFFERS[dtype] for dtype, name in _C_TYPES.items()}
    known = {"function": function, "nothing": NOTHING, "of_array": _FFI.from_buffer, "as_c": _as_c, "faults": _FAULTS}
    space: dict[str, Any] = known | types | {dtype.name: dtype for dtype in _C_TYPES}
    exec(written, space)
    call: Callable[..., None] = space["call"]
    return call


def _as_c(value: Any) -> Any:
    """An array stored otherwise, as one that C reads; a number as it is."""
    if not isinstance(value, np.ndarray):
        return value
    native = value.dtype.newbyteorder("=")
    if native not in _BUFFERS:
        raise TypeError(f"no kernel takes {native}")
    return _FFI.from_buffer(_BUFFERS[native], np.ascontiguousarray(value, dtype=native))


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


def damaged() -> list[Path]:
    """Libraries of this source that are there and not whole."""
    made_of = digest()
    there = (library(level, made_of) for level in levels())
    return [path for path in there if path.exists() and not is_whole(path)]


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
