"""Language of the window, and of single threads.

One translator is installed once and looks up the language of the calling thread, so a report can be painted in
another language in its own thread while the window keeps its own.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import resources
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from carpus.core.model.phrase import LANGUAGES

_DEFAULT_LOCALES = {
    "en": QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom),
    "de": QLocale(QLocale.Language.German, QLocale.Country.Germany),
    "it": QLocale(QLocale.Language.Italian, QLocale.Country.Italy),
}

TextLookup = Callable[[str, str], str | None]
"""Returns the translation of a text in a context, None if there is none."""


class _ThreadLanguage(threading.local):
    """Language code of this thread within :func:`use_language`; empty for the window's."""

    code = ""


class _Translator(QTranslator):
    """Translator that looks up each text in the language of the calling thread."""

    def __init__(self) -> None:
        super().__init__()
        self.lookups: dict[str, TextLookup] = {"en": lambda context, text: None}
        self.locales: dict[str, QLocale] = dict(_DEFAULT_LOCALES)
        self.window_language = ""

    def translate(self, context: str, text: str, disambiguation: str | None = None, number: int = -1) -> str | None:
        find = self.lookups.get(_THREAD_LANGUAGE.code or self.window_language)
        return find(context or "", text or "") if find is not None else None

    def isEmpty(self) -> bool:
        return False


_THREAD_LANGUAGE = _ThreadLanguage()
_TRANSLATOR: list[_Translator] = []


def parse_texts(ts_file: bytes) -> dict[tuple[str, str], str]:
    """Parse a Qt Linguist file into texts by (context, English text).

    Unfinished translations that have a text count.
    """
    found = {}
    for context in ElementTree.fromstring(ts_file).iter("context"):
        name = context.findtext("name") or ""
        for message in context.iter("message"):
            translation = message.find("translation")
            if translation is not None and translation.get("type") not in ("vanished", "obsolete"):
                text = "".join(translation.itertext())
                if text.strip():
                    found[name, message.findtext("source") or ""] = text
    return found


def set_window_language(code: str) -> None:
    """Set the window's language; ``system`` for that of the computer.

    Call it in the window's thread once there is an application.
    """
    translator = _translator()
    chosen = code if code in translator.locales else system_language()
    _load_language(translator, chosen)
    translator.window_language = chosen
    QLocale.setDefault(translator.locales[chosen])


@contextmanager
def use_language(code: str) -> Iterator[None]:
    """Use another language in this thread; empty for the window's.

    ``Background`` passes it on to its tasks.
    """
    if code:
        _load_language(_translator(), code)
    before, _THREAD_LANGUAGE.code = _THREAD_LANGUAGE.code, code
    try:
        yield
    finally:
        _THREAD_LANGUAGE.code = before


def current_language() -> str:
    """Return the language code of the calling thread."""
    return _THREAD_LANGUAGE.code or (_TRANSLATOR[0].window_language if _TRANSLATOR else "") or "en"


def thread_language() -> str:
    """Return the code set by :func:`use_language`, empty outside of it."""
    return _THREAD_LANGUAGE.code


def locale() -> QLocale:
    """Return the locale for numbers and dates of the calling thread."""
    return _TRANSLATOR[0].locales[_THREAD_LANGUAGE.code] if _THREAD_LANGUAGE.code and _TRANSLATOR else QLocale()


def system_language() -> str:
    """Return the first of the user's languages that Carpus has, else English."""
    for name in QLocale.system().uiLanguages():
        code = name.replace("_", "-").split("-")[0].lower()
        if code in LANGUAGES:
            return code
    return "en"


def _translator() -> _Translator:
    """Return the one translator. The window's thread must install it before any other thread paints."""
    if not _TRANSLATOR:
        _TRANSLATOR.append(_Translator())
        QCoreApplication.installTranslator(_TRANSLATOR[0])
    return _TRANSLATOR[0]


def _load_language(translator: _Translator, code: str) -> None:
    """Load a language at its first use, with the locale of the user's own country if it fits."""
    if code in translator.lookups and code != "en":
        return
    own = QLocale.system()
    if code in _DEFAULT_LOCALES and own.language() == _DEFAULT_LOCALES[code].language():
        plain = QLocale(own.language(), own.territory())
        # A computer may speak one language and name its days in another: nothing is mixed here.
        translator.locales[code] = own if own.dayName(1) == plain.dayName(1) else plain
    if code != "en":
        file = resources.files("carpus.resources") / "translations" / f"carpus_{code}.ts"
        translator.lookups[code] = _make_lookup(parse_texts(file.read_bytes()), code)


def _make_lookup(texts: dict[tuple[str, str], str], code: str) -> TextLookup:
    """Return a lookup of Carpus's own texts, then of those of Qt's dialogs."""
    qt = QTranslator()
    qt.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))

    def lookup(context: str, text: str) -> str | None:
        own = texts.get((context, text))
        return own if own is not None else qt.translate(context, text) or None

    return lookup
