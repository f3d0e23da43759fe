"""The formats that a session can be written in: one line here and one module for each.

A module has ``write(take, folder)`` and, where a format speaks of all sessions together, ``check(folder)`` before the
first, ``complete(folder, abouts)`` after the last and ``OWN_FOLDER``. It is loaded only when it is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:  # the list itself is read by windows, which load nothing that reads files
    from carpus.core.formats.take import About, Take


class Format(NamedTuple):
    """``words`` say what it is for."""

    module: str
    words: str


FORMATS = {
    "csv": Format("csv_tables", "tables of angles, joints, markers, events and measures"),
    "json": Format("json_measures", "measures with provenance"),
    "c3d": Format("c3d_write", "markers for motion capture programs"),
    "trc": Format("trc", "markers for OpenSim"),
    "mot": Format("mot", "angles for OpenSim"),
    "bids": Format("bids_motion", "a BIDS-Motion data set"),
    "h5": Format("session_copy", "the session itself without pictures, to be imported again"),
}


class Writer:
    """One format in one export."""

    def __init__(self, name: str, folder: Path, alone: bool) -> None:
        self._module: Any = import_module(f"{__package__}.{FORMATS[name].module}")
        own = getattr(self._module, "OWN_FOLDER", "")
        self.name, self.folder = name, folder / own if own and not alone else folder
        self._written: list[About] = []

    def check(self) -> None:
        """Raise a fault that is known before anything is written."""
        check = getattr(self._module, "check", None)
        if check is not None:
            check(self.folder)

    def write(self, take: Take, of: About) -> Sequence[Path]:
        """Of one session; the files."""
        out: Sequence[Path] = self._module.write(take, self.folder)
        self._written.append(of)
        return out

    def complete(self) -> Sequence[Path]:
        """What speaks of all sessions."""
        complete = getattr(self._module, "complete", None)
        return complete(self.folder, self._written) if complete is not None and self._written else ()
