"""What Carpus is for is said in the same words wherever a newcomer reads it first, and the papers are named."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from carpus.app.__main__ import build_parser, main
from carpus.core.model.purpose import PURPOSE
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.welcome.panel import WelcomePanel

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_help_first_start_and_readme_name_the_same_five_things(
    qtbot: QtBot, capsys: pytest.CaptureFixture[str]
) -> None:
    assert [word for word, _ in PURPOSE] == ["Measure", "Review", "Progress", "Report", "Export"]
    with pytest.raises(SystemExit):
        main(["--help"])
    told = capsys.readouterr().out
    panel = WelcomePanel(Theme("light"))
    qtbot.addWidget(panel)
    for word, meaning in PURPOSE:
        assert re.search(rf"^  {word} +{re.escape(meaning)}$", told, re.MULTILINE)
        assert f"- **{word}** {meaning}\n" in README
        assert f"{word}: {meaning}" in panel.purpose.text()


def test_commands_of_the_readme_can_be_typed() -> None:
    lines = re.findall(r"^\.venv/bin/(carpus .+)$", README, re.MULTILINE)
    lines += re.findall(r"`\.venv/bin/(carpus[^`]*)`", README)
    assert len(lines) >= 6
    for line in lines:
        words = shlex.split(line)[1:]
        build_parser(words).parse_args(words)
