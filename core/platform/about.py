"""Packages that Carpus uses, with their licences."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path

from carpus.core.model.installation import is_packed

_LICENCE_NAMES = ("LICEN", "COPYING", "NOTICE", "AUTHORS")
_FOLDERS = ("licences", "fonts", "icons")
"""Resources with licences: packed libraries, typeface, icons."""
_MAX_EXPRESSION = 80
PACKED_TEXTS = "licences.txt"
"""Beside the packed program."""


@dataclass(frozen=True, slots=True)
class BundledPart:
    """Package with its licence in few words and in full; both may be empty."""

    name: str
    version: str
    licence: str
    texts: tuple[str, ...] = ()


def list_bundled_parts() -> list[BundledPart]:
    """Return all installed packages that the program needs, itself first, then by name."""
    seen: dict[str, BundledPart] = {}
    waiting = ["carpus"]
    while waiting:
        name = _normalize_name(waiting.pop())
        if name in seen:
            continue
        try:
            found = distribution(name)
        except PackageNotFoundError:
            continue
        seen[name] = BundledPart(
            found.metadata["Name"], found.version, _licence_name(found), tuple(_licence_texts(found))
        )
        needs = (line.partition(";") for line in found.requires or ())
        waiting += [re.split(r"[<>=!~ \[(]", need.strip())[0] for need, _, marker in needs if "extra" not in marker]
    return sorted(seen.values(), key=lambda part: (_normalize_name(part.name) != "carpus", _normalize_name(part.name)))


def licence_texts() -> str:
    """Return the list of packages and all licence texts; a packed program has them ready."""
    ready = Path(sys.executable).parent / PACKED_TEXTS
    if is_packed() and ready.is_file():
        return ready.read_text(encoding="utf-8", errors="replace")
    parts = list_bundled_parts()
    lines = ["Carpus is made with these parts:", ""]
    lines += [f"{part.name} {part.version}: {part.licence or 'see its text below'}" for part in parts]
    lines += [
        "",
        "Qt and PySide (LGPL 3) are used as libraries of their own, which may be replaced by other builds of theirs:",
        "in the installed program they lie as files in its folder “parts/PySide6”.",
        "",
    ]
    for part in parts:
        for text in part.texts:
            lines += ["=" * 80, f"{part.name} {part.version}", "=" * 80, text.strip(), ""]
    for name, text in _resource_texts():
        lines += ["=" * 80, name, "=" * 80, text.strip(), ""]
    return "\n".join(lines)


def _normalize_name(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _licence_name(found: Distribution) -> str:
    get_all = found.metadata.get_all
    licence = next(iter((*(get_all("License-Expression") or ()), *(get_all("License") or ()))), "")
    if licence and len(licence) <= _MAX_EXPRESSION and "\n" not in licence:
        return licence
    kinds = [line for line in get_all("Classifier") or () if line.startswith("License ::")]
    if kinds:
        return ", ".join(kind.rpartition(":: ")[2] for kind in kinds)
    title = next(_licence_texts(found), "").strip().partition("\n")[0]  # as its text calls itself
    return title if len(title) <= _MAX_EXPRESSION else ""


def _licence_texts(found: Distribution) -> Iterator[str]:
    for path in sorted(found.files or (), key=str):
        in_metadata = any(folder.endswith(".dist-info") for folder in path.parts[:-1])
        if in_metadata and path.name.upper().startswith(_LICENCE_NAMES) and Path(str(path.locate())).is_file():
            yield Path(str(path.locate())).read_text(encoding="utf-8", errors="replace")


def _resource_texts() -> Iterator[tuple[str, str]]:
    for folder in _FOLDERS:
        place = files("carpus.resources").joinpath(folder)
        if place.is_dir():
            for file in sorted(place.iterdir(), key=lambda one: one.name):
                is_licence = file.name.upper().startswith((*_LICENCE_NAMES, "OFL")) or folder == "licences"
                if is_licence and file.is_file():
                    yield f"{folder}/{file.name}", file.read_bytes().decode("utf-8", errors="replace")
