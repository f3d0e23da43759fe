"""The page of all fault codes, made from the classes; ``python -m tests.fault_page`` writes it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from carpus.core.model.errors import CarpusFault, Notice
from carpus.core.model.fault_text import format_fault

PAGE = Path(__file__).parents[1] / "resources" / "faults.md"
HEAD = """# Fault codes

Each message of Carpus has a code, in the window, on the command line and in the log. This page is made from the
program. It says what happened, whether data are safe, what to do, and what IT support can do. `C-000` is an error in
the program itself.

| code | about | what happened | data | what to do | for IT support |
|---|---|---|---|---|---|
"""


def all_faults(of: type[CarpusFault] = CarpusFault) -> Iterator[type[CarpusFault]]:
    """Every kind of fault that has a code."""
    for kind in of.__subclasses__():
        if kind is not Notice:
            yield kind
        yield from all_faults(kind)


def fault_page() -> str:
    """Markdown text; kept in ``resources/faults.md``."""
    rows = []
    for kind in sorted(all_faults(), key=lambda kind: kind.code):
        words = format_fault(kind("…", "…"), is_brief=True)
        cells = (f"`{kind.code}`", words.title, words.summary, words.data_safety, words.remedy, kind.support)
        rows.append(f"| {' | '.join(cells)} |".replace(": ….", "."))
    return HEAD + "\n".join(rows) + "\n"


if __name__ == "__main__":
    PAGE.write_text(fault_page(), encoding="utf-8")
