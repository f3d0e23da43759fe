"""``python -m tests.accuracy.pages TABLES``: puts the tables that ``make accuracy`` printed as Markdown into the pages.

The run takes long and its figures are read before they are told: it prints, and this puts what it printed between the
marks of the same name in the pages.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = tuple(ROOT / page for page in ("README.md", "resources/accuracy.md", "resources/research-notes/accuracy.md"))
_MARKED = re.compile(r"<!-- table: (?P<name>[\w ]+) -->\n.*?<!-- end of table -->", re.DOTALL)


def mark_table(name: str, table: str) -> str:
    """A table between the marks that say which it is."""
    return f"<!-- table: {name} -->\n\n{table}\n\n<!-- end of table -->"


def rule_table(rows: Sequence[Sequence[str]]) -> str:
    """Rows as a Markdown table, the head first."""
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([lines[0], "|---" * len(rows[0]) + "|", *lines[1:]])


def find_tables(text: str) -> dict[str, str]:
    """The marked tables of a text, with their marks, by name."""
    return {found["name"]: found[0] for found in _MARKED.finditer(text)}


def with_tables(text: str, tables: dict[str, str]) -> str:
    """The text, each of its marked tables replaced by the one of the same name, if there is one."""
    return _MARKED.sub(lambda found: tables.get(found["name"], found[0]), text)


def main(arguments: Sequence[str]) -> int:
    if len(arguments) != 1:
        print("usage: python -m tests.accuracy.pages FILE", file=sys.stderr)
        return 2
    tables, placed = find_tables(Path(arguments[0]).read_text(encoding="utf-8")), set[str]()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        placed |= find_tables(text).keys() & tables.keys()
        page.write_text(with_tables(text, tables), encoding="utf-8")
    print(f"in place: {', '.join(sorted(placed)) or 'none'}", file=sys.stderr)
    if left := sorted(tables.keys() - placed):
        print(f"no page has a place for: {', '.join(left)}", file=sys.stderr)
    return 0 if placed and not left else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
