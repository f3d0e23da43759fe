"""Names that people give to cameras which do not tell their serial number, kept by the kind of camera."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from carpus.core.capture.source import GIVEN, SERIAL, FrameSource, SourceInfo
from carpus.core.durable import replace_file
from carpus.core.errors import OutputNotWritable
from carpus.core.names import CAMERAS
from carpus.core.types import Frame

MOST_LETTERS = 40
_FILE = "names.json"


class NamedSource:
    """``source`` with the name that a person gave to its camera."""

    def __init__(self, source: FrameSource, name: str) -> None:
        self._source = source
        settings = {**source.info.settings, SERIAL: name, GIVEN: "yes"}
        self.info: SourceInfo = replace(source.info, settings=settings)

    def frames(self) -> Iterator[Frame]:
        return self._source.frames()

    def close(self) -> None:
        self._source.close()


def with_given_name(source: FrameSource, data_folder: Path) -> FrameSource:
    """``source`` under the name that its kind of camera was given; itself where it tells its number, or has no name."""
    if source.info.serial:
        return source
    name = _names(data_folder).get(source.info.name, "")
    return NamedSource(source, name) if name else source


def tidy_name(typed: str) -> str:
    """A name as it is kept.

    >>> tidy_name("  room 3\\t left ")
    'room 3 left'
    """
    return " ".join("".join(letter if letter.isprintable() else " " for letter in typed).split())[:MOST_LETTERS].strip()


def keep_name(data_folder: Path, kind: str, name: str) -> str:
    """From now on cameras of a kind that do not tell their number are called so: the name as it is kept. A name
    that another kind has gets the kind added, else one would be seen through the other's calibration.

    Raises :class:`OutputNotWritable` or :class:`DiskFull`.
    """
    path = data_folder / CAMERAS / _FILE
    others = {other: taken for other, taken in _names(data_folder).items() if other != kind}
    kept = tidy_name(name)
    if kept in others.values():
        of_kind = f" ({tidy_name(kind)[: MOST_LETTERS // 2]})"
        kept = tidy_name(kept[: MOST_LETTERS - len(of_kind)] + of_kind)
    names = {**others, kind: kept}
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause
    replace_file(path, lambda part: part.write_text(json.dumps(names, ensure_ascii=False), encoding="utf-8"))
    return kept


def _names(data_folder: Path) -> dict[str, str]:
    try:
        known = json.loads((data_folder / CAMERAS / _FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(known, dict):
        return {}
    return {str(kind): tidy for kind, name in known.items() if isinstance(name, str) and (tidy := tidy_name(name))}
