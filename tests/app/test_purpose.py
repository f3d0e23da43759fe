"""What Carpus is for is said in the same words wherever a newcomer reads it first, and the papers are named."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

from carpus.app.__main__ import build_parser

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_commands_of_the_readme_can_be_typed() -> None:
    lines = re.findall(r"^\.venv/bin/(carpus .+)$", README, re.MULTILINE)
    lines += re.findall(r"`\.venv/bin/(carpus[^`]*)`", README)
    assert len(lines) >= 6
    for line in lines:
        words = shlex.split(line)[1:]
        build_parser(words).parse_args(words)
