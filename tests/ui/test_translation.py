"""Every text can be translated: written as a literal, in a context that Qt's tools and the program agree on."""

from __future__ import annotations

import ast
import re
import threading
from datetime import date
from functools import cache
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QLocale
from pytestqt.qtbot import QtBot

from carpus.core.model.phrase import LANGUAGES
from carpus.ui.kit import language
from carpus.ui.kit.background import Background
from carpus.ui.kit.numbers import format_day_month
from carpus.ui.kit.translate import tr
from installer import translations
from tests.sources import ROOT, SOURCES, modules, parse_file
from tests.ui.pseudo import register

UI = modules("ui")


@cache
def tr_calls(path: Path) -> list[ast.Call]:
    """Calls of ``tr``, as a function or a widget's method."""
    calls = [node for node in ast.walk(parse_file(path)) if isinstance(node, ast.Call)]
    return [call for call in calls if getattr(call.func, "id", getattr(call.func, "attr", "")) == "tr"]


@SOURCES
def test_texts_are_literals_with_named_places_for_what_is_filled_in() -> None:
    calls = [(f"{path}, line {call.lineno}", call) for path in UI for call in tr_calls(path)]
    assert calls
    wrong = []
    for place, call in calls:
        text = call.args[0].value if isinstance(call.args[0], ast.Constant) else None
        if text is None:
            wrong.append(f"{place}: not a literal")
        elif re.search(r"\{\}|\{\d", text):
            wrong.append(f"{place}: {text}")
    assert wrong == []


@pytest.fixture(scope="module")
def extracted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All texts of the sources, as ``make translations`` has Qt's tool find them, none of them translated."""
    path = tmp_path_factory.mktemp("texts") / "xx.ts"
    translations.update(path, "de_CH")
    return path


def test_page_in_another_language_is_painted_in_thread_own_while_window_continues_in_its_own(qtbot: QtBot) -> None:
    register("xx", lambda context, text: f"¡{text}" if text == "Cancel" else None, QLocale("de_CH"))
    background, said = Background(), []
    go_on = threading.Event()

    def work() -> str:
        go_on.wait(20.0)
        return tr("Cancel") + format_day_month(date(2026, 11, 13)) + language.current_language()

    with language.use_language("xx"):
        background.run(work, said.append, said.append)
    assert tr("Cancel") == "Cancel"
    go_on.set()
    qtbot.waitUntil(lambda: bool(said), timeout=20_000)
    assert said == ["¡Cancel13 Nov.xx"]


def test_window_speaks_what_is_chosen_with_qt_s_own_texts_and_dates(qtbot: QtBot) -> None:
    try:
        language.set_window_language("de")
        assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Abbrechen"
        assert QLocale().toString(1.5, "f", 1) == "1,5"
    finally:
        language.set_window_language("en")
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Cancel"
    assert QLocale().toString(1.5, "f", 1) == "1.5"
    assert language.system_language() in LANGUAGES


@pytest.mark.parametrize("code", [code for code in LANGUAGES if code != "en"])
def test_translations_are_complete_with_same_placeholders(code: str, extracted: Path) -> None:
    kept = ROOT / "resources" / "translations" / f"carpus_{code}.ts"
    texts = language.parse_texts(kept.read_bytes())
    unfinished = set(translations.missing(kept))
    said_in_sources = translations.missing(extracted)
    assert len(said_in_sources) > 1000
    assert [key for key in said_in_sources if key not in texts or key in unfinished] == []
    places = re.compile(r"\{[^}]*\}")
    for (context, text), said in texts.items():
        assert sorted(places.findall(text)) == sorted(places.findall(said)), (context, text, said)
        assert ("&" in text.replace("&&", "")) == ("&" in said.replace("&&", "")), (context, text, said)
    letters: dict[tuple[str, str], set[str]] = {}
    for (context, text), said in texts.items():
        if context and (found := re.search(r"(?<!&)&(\w)", said)):
            letters.setdefault((context, found[1].lower()), set()).add(re.search(r"&(\w)", text)[1].lower())  # type: ignore[index]
    assert not {key: own for key, own in letters.items() if len(own) > 1}, "two keys of a screen became one"
