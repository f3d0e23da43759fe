"""A printed page, read back by poppler's tools."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

from PySide6.QtWidgets import QLabel

from carpus.core.session.values import Session
from carpus.ui.report.page import Report, layout_pages, write_report
from carpus.ui.report.session_page import SessionReport, build_session_report


def write_session_report(report: Session | SessionReport, path: Path, **context: Any) -> Path:
    """Write the report of a session as PDF, built of it first if it is given."""
    return write_report(build_session_report(report, **context) if isinstance(report, Session) else report, path)


def page_words(report: Report) -> str:
    """All words that are laid out on the pages, with one space between; without those of the charts."""
    parts = [part for page in layout_pages(report) for part, _, _ in page._parts]
    return " ".join(" ".join(label.text() for part in parts for label in part.findChildren(QLabel)).split())


def tool(name: str, *arguments: str) -> str:
    path = shutil.which(name)
    assert path is not None, f"{name} (poppler-utils) is needed to read what was printed"
    return subprocess.run([path, *arguments], capture_output=True, text=True, check=True).stdout


def read_words(path: Path, page: int = 0) -> str:
    """All words, or those of a page, with one space between."""
    pages = ("-f", str(page), "-l", str(page)) if page else ()
    return " ".join(tool("pdftotext", "-layout", *pages, str(path), "-").split())


def count_pages(path: Path) -> int:
    return int(re.findall(r"Pages:\s+(\d+)", tool("pdfinfo", str(path)))[0])


def measure_reach(path: Path) -> tuple[float, float, float, float]:
    """How far left, up, right and down the words of all pages reach, in points from the upper left corner."""
    boxes = tool("pdftotext", "-bbox", str(path), "-")
    left, top, right, foot = (
        [float(one) for one in re.findall(rf' {name}="([-\d.]+)"', boxes)] for name in ("xMin", "yMin", "xMax", "yMax")
    )
    return min(left), min(top), max(right), max(foot)


def overlapping_words(path: Path) -> list[tuple[str, str]]:
    """Words of a page that are printed over one another; those of the watermark, which lies behind, are not among
    them."""
    found: list[tuple[str, str]] = []
    for page in tool("pdftotext", "-bbox", str(path), "-").split("<page ")[1:]:
        words = re.findall(r'xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>', page)
        boxes = [(*map(float, one[:4]), one[4]) for one in words if float(one[3]) - float(one[1]) < 30.0]
        for at, (left, top, right, foot, word) in enumerate(boxes):
            for other_left, other_top, other_right, other_foot, other in boxes[at + 1 :]:
                across = min(right, other_right) - max(left, other_left)
                down = min(foot, other_foot) - max(top, other_top)
                if across > 0.5 and down > 0.4 * min(foot - top, other_foot - other_top):
                    found.append((word, other))
    return found
