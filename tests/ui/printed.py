"""A printed page, read back by poppler's tools."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path


def tool(name: str, *arguments: str) -> str:
    path = shutil.which(name)
    assert path is not None, f"{name} (poppler-utils) is needed to read what was printed"
    return subprocess.run([path, *arguments], capture_output=True, text=True, check=True).stdout


def words_of(path: Path, page: int = 0) -> str:
    """All words, or those of a page, with one space between."""
    pages = ("-f", str(page), "-l", str(page)) if page else ()
    return " ".join(tool("pdftotext", "-layout", *pages, str(path), "-").split())


def pages_of(path: Path) -> int:
    return int(re.findall(r"Pages:\s+(\d+)", tool("pdfinfo", str(path)))[0])


def reach_of(path: Path) -> tuple[float, float, float, float]:
    """How far left, up, right and down the words of all pages reach, in points from the upper left corner."""
    boxes = tool("pdftotext", "-bbox", str(path), "-")
    left, top, right, foot = (
        [float(one) for one in re.findall(rf' {name}="([-\d.]+)"', boxes)] for name in ("xMin", "yMin", "xMax", "yMax")
    )
    return min(left), min(top), max(right), max(foot)
