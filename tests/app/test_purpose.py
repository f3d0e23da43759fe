"""What Carpus is for is said in the same words wherever a newcomer reads it first, and the papers are named."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
import yaml
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


def test_papers_are_both_cited() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert len(cited["references"]) == 2
    for paper in cited["references"]:
        assert paper["title"] in README.replace("\n", " ")
        assert paper["year"] == 2013
        assert "doi" not in paper, "no copy at hand names one: look it up first"
        assert all(author["family-names"] in README for author in paper["authors"])


def test_readme_is_one_page() -> None:
    assert len(README.splitlines()) <= 100
    assert README.count("![") == 1
