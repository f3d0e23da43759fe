"""The guide: every page and picture is there, links lead on, quotes are true, the cards print."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtGui import QImage
from pytestqt.qtbot import QtBot

from carpus.core.model.errors import OutputNotWritable
from carpus.core.model.phrase import LANGUAGES
from carpus.ui.kit.language import parse_texts, use_language
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.help import guide
from carpus.ui.screens.help.screen import HelpScreen
from tests.ui.conftest import Show
from tests.ui.printed import count_pages, read_words

RESOURCES = Path(__file__).parents[2] / "resources"
GUIDE = RESOURCES / "guide"


def test_guide_pages_match_the_list() -> None:
    assert {path.name for path in GUIDE.iterdir() if path.is_dir()} == {*LANGUAGES}
    for code in LANGUAGES:
        assert {path.stem for path in (GUIDE / code).glob("*.md")} == set(guide.PAGES)


def test_guide_languages_have_the_same_structure() -> None:
    parts = re.compile(r"^(?:#+|-|\d+\.) |\]\([\w.-]+\)", re.MULTILINE)
    said: dict[str, set[str]] = {}
    for code in LANGUAGES:
        with use_language(code):
            for page in guide.PAGES:
                assert parts.findall(guide.load_page(page)) == parts.findall(_english(page)), (code, page)
            said[code] = {guide.page_title(page) for page in guide.PAGES}
    assert not said["en"] & said["de"]
    assert not said["en"] & said["it"]


QUOTED = {"en": "“([^“”]+)”", "de": "„([^„“]+)“", "it": "“([^“”]+)”|«([^«»]+)»"}
NO_TEXT_OF_THE_WINDOW = {
    "carpus doctor",
    "actual size", "Originalgröße", "dimensioni effettive",
    "at least", "mindestens", "almeno",
    "no change", "unverändert", "nessun cambiamento",
}  # fmt: skip
"""A command, a printer's word, and what figures are said to mean."""


@pytest.mark.parametrize("code", LANGUAGES)
def test_guide_quotes_are_texts_of_the_window(code: str) -> None:
    file = RESOURCES / "translations" / f"carpus_{'de' if code == 'en' else code}.ts"
    texts = {source if code == "en" else said for (_, source), said in parse_texts(file.read_bytes()).items()}
    names = re.compile(r"\{[^}]*\}")
    known = [
        re.compile(".+".join(map(re.escape, names.split(_bare(text.replace("&", ""))))))
        for text in texts
        if len(re.sub(r"\W", "", names.sub("", text))) > 2
    ]
    for path in (GUIDE / code).glob("*.md"):
        for found in re.finditer(QUOTED[code], path.read_text("utf-8")):
            said = next(filter(None, found.groups()))
            if said not in NO_TEXT_OF_THE_WINDOW:
                assert any(one.fullmatch(_bare(said)) for one in known), (path.name, said)


def _bare(text: str) -> str:
    return text.rstrip("….:, ").strip()


def _english(page: str) -> str:
    return (GUIDE / guide.DEFAULT_LANGUAGE / f"{page}.md").read_text("utf-8")


@pytest.mark.parametrize("code", LANGUAGES)
def test_guide_pages_as_html_have_links_and_pictures_and_no_markdown(code: str) -> None:
    pictures: set[str] = set()
    with use_language(code):
        for page in guide.PAGES:
            body = guide.page_html(page, Theme("light"), 500).split("<body>")[1]
            assert set(re.findall(r'<a href="(\w+)">', body)) <= set(guide.PAGES)
            pictures.update(re.findall(r'<img src="([^"]+)"', body))
            for mark in ("**", "](", "|", "`"):
                assert mark not in body
            for tag in ("ul", "ol"):
                assert body.count(f"<{tag}>") == body.count(f"</{tag}>")
            assert "<" not in re.sub(r"<[^>]*>", "", body)
        assert {path.name for path in (GUIDE / code).iterdir() if path.suffix != ".md"} == pictures
        assert all(QImage(guide.picture_path(name)).width() >= 1000 for name in pictures)


def test_help_screen_opens_page_links_and_pictures(theme: Theme, show: Show[HelpScreen]) -> None:
    screen = show(HelpScreen(theme))
    screen.show_page("camera")
    assert screen.index.currentItem().text() == guide.page_title("camera")
    assert "70 to 80 cm" in screen.page_view.toPlainText()
    screen.page_view.anchorClicked.emit(QUrl("correct"))
    assert screen.page == "correct"
    assert screen.page_view.loadResource(2, QUrl("discs-6.png")) is not None
    screen.show_page(guide.KEYS_PAGE)
    assert "Shift+F10" in screen.page_view.toPlainText()


def test_write_cards_makes_two_pages_with_their_texts(qtbot: QtBot, tmp_path: Path) -> None:
    guide.write_cards(tmp_path / "cards.pdf")
    assert count_pages(tmp_path / "cards.pdf") == 2
    assert "Thumb base (CMC)" in read_words(tmp_path / "cards.pdf", 1)
    assert "70 to 80 cm" in read_words(tmp_path / "cards.pdf", 2)
    with pytest.raises(OutputNotWritable):
        guide.write_cards(tmp_path / "cards.pdf" / "no folder" / "cards.pdf")
