"""The newest version in a folder of packages that the clinic itself named; nobody else is ever asked."""

from __future__ import annotations

import re
from pathlib import Path

_PACKAGE = "carpus"


def newest_version(folder: Path) -> str:
    """Of the packages listed in an apt repository's folder, empty for none. Raises :class:`OSError`."""
    text = (folder / "Packages").read_text(encoding="utf-8", errors="replace")
    found = []
    for part in text.split("\n\n"):
        fields = dict(re.findall(r"^(Package|Version): *(\S+)$", part, re.MULTILINE))
        if fields.get("Package") == _PACKAGE and "Version" in fields:
            found.append(fields["Version"].replace("~", ""))
    return max(found, key=_order, default="")


def is_newer(version: str, than: str) -> bool:
    """Whether a version, written as Python or Debian does, comes after another.

    >>> is_newer("0.10.0", "0.9.1"), is_newer("0.2.0rc1", "0.2.0"), is_newer("0.2.0", "0.2.0")
    (True, False, False)
    """
    return _order(version) > _order(than)


def _order(version: str) -> tuple[tuple[int, ...], bool, tuple[int, ...]]:
    release, before = re.findall(r"^([\d.]*)(.*)", version.replace("~", ""))[0]
    return tuple(map(int, re.findall(r"\d+", release))), not before, tuple(map(int, re.findall(r"\d+", before)))
