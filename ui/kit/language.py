"""Which language the program speaks: the window's, or for a moment another one's.

One translator is installed once and asks for the language that is spoken in its thread; nothing is installed later,
so a report may be painted in another language in a thread of its own while the window goes on in its own.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import resources
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

LANGUAGES = {"en": "English", "de": "Deutsch", "it": "Italiano"}
"""Languages by their own names; a new one is a line here, one in ``_DEFAULT_LOCALES`` and its file in
resources/translations."""

_DEFAULT_LOCALES = {
    "en": QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom),
    "de": QLocale(QLocale.Language.German, QLocale.Country.Germany),
    "it": QLocale(QLocale.Language.Italian, QLocale.Country.Italy),
}

TextLookup = Callable[[str, str], str | None]
"""The translation of a text in a context, None where there is none."""


class _ThreadLanguage(threading.local):
    """The language of this thread while :func:`use_language`; empty for the window's."""

    code = ""


class _Translator(QTranslator):
    """Asks for every text in the language that is spoken where it is asked for."""

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


def load_texts(code: str) -> dict[tuple[str, str], str]:
    """What the kept file of a language says, by context and English text; unfinished texts that are there count."""
    return parse_texts((resources.files("carpus.resources") / "translations" / f"carpus_{code}.ts").read_bytes())


def parse_texts(ts_file: bytes) -> dict[tuple[str, str], str]:
    """What a file of Qt Linguist says, as above."""
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
    """From now on the window's language; ``system`` for the computer's. To be called in the window's thread, once
    there is an application."""
    chosen = code if code in available_languages() else system_language()
    translator = _translator()
    _load_language(translator, chosen)
    translator.window_language = chosen
    QLocale.setDefault(translator.locales[chosen])


@contextmanager
def use_language(code: str) -> Iterator[None]:
    """Meanwhile this thread speaks another language; empty for the window's. Work that is given to another thread
    through ``Background`` takes it along."""
    if code:
        _load_language(_translator(), code)
    before, _THREAD_LANGUAGE.code = _THREAD_LANGUAGE.code, code
    try:
        yield
    finally:
        _THREAD_LANGUAGE.code = before


def current_language() -> str:
    """The language spoken here and now."""
    return _THREAD_LANGUAGE.code or (_TRANSLATOR[0].window_language if _TRANSLATOR else "") or "en"


def thread_language() -> str:
    """The language of :func:`use_language`, empty outside of it."""
    return _THREAD_LANGUAGE.code


def locale() -> QLocale:
    """How numbers and dates are written here and now."""
    return _TRANSLATOR[0].locales[_THREAD_LANGUAGE.code] if _THREAD_LANGUAGE.code and _TRANSLATOR else QLocale()


def system_language() -> str:
    """The first of the person's languages that Carpus speaks; English where it speaks none."""
    for name in QLocale.system().uiLanguages():
        code = name.replace("_", "-").split("-")[0].lower()
        if code in LANGUAGES:
            return code
    return "en"


def available_languages() -> tuple[str, ...]:
    """All languages that can be spoken."""
    return tuple(_TRANSLATOR[0].locales) if _TRANSLATOR else tuple(LANGUAGES)


def register_language(code: str, lookup: TextLookup, number_locale: QLocale) -> None:
    """Another language, whose texts ``lookup`` gives; numbers and dates ``number_locale`` in it."""
    translator = _translator()
    translator.lookups[code], translator.locales[code] = lookup, number_locale


def _translator() -> _Translator:
    """The one translator. What installs it must be the window's thread, which does so before any other paints."""
    if not _TRANSLATOR:
        _TRANSLATOR.append(_Translator())
        QCoreApplication.installTranslator(_TRANSLATOR[0])
    return _TRANSLATOR[0]


def _load_language(translator: _Translator, code: str) -> None:
    """Read a language when it is first spoken, and take the person's own country's locale where it is theirs."""
    if code in translator.lookups and code != "en":
        return
    own = QLocale.system()
    if code in _DEFAULT_LOCALES and own.language() == _DEFAULT_LOCALES[code].language():
        plain = QLocale(own.language(), own.territory())
        # A computer may speak one language and name its days in another: nothing is mixed here.
        translator.locales[code] = own if own.dayName(1) == plain.dayName(1) else plain
    if code != "en":
        translator.lookups[code] = _make_lookup(load_texts(code), code)


def _make_lookup(texts: dict[tuple[str, str], str], code: str) -> TextLookup:
    """Carpus's own texts, then those of Qt's dialogs and buttons."""
    qt = QTranslator()
    qt.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))

    def lookup(context: str, text: str) -> str | None:
        own = texts.get((context, text))
        return own if own is not None else qt.translate(context, text) or None

    return lookup
