"""A language that nobody speaks: 40 % longer than English, with accents and brackets, to see where room is missing
and what was never given to a translator. ``python -m tests.ui.pseudo [CODE] [WxH@SCALE] [STATE...]`` looks at every
state of the gallery in it, or in a language that people do speak."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QLocale

from carpus.ui.kit import language

CODE = "xx"
_PLACES = re.compile(r"(\{[^}]*\}|&.)")
_ACCENTS = str.maketrans("aeiouAEIOUcnsz", "áéíóúÁÉÍÓÚçñšž")
_NO_WORDS = re.compile(r"^(\W*|d+ .*MMM.*|d MMM)$|^words that lose")


def pseudo(text: str) -> str:
    """``[Cááñçéél]`` for Cancel: every vowel twice, places and keys kept.

    >>> pseudo("Keep {count} &pictures")
    '[Kéééép {count} &pííçtúúrééš]'
    """
    if _NO_WORDS.search(text):
        return text
    parts = _PLACES.split(text)
    parts[::2] = [re.sub(r"([aeiouAEIOU])", lambda one: one[1] + one[1].lower(), part) for part in parts[::2]]
    parts[::2] = [part.translate(_ACCENTS) for part in parts[::2]]
    return f"[{''.join(parts)}]"


def is_pseudo(text: str) -> bool:
    """Whether a text on the screen came through the language."""
    return "[" in text or "]" in text or any(letter in text for letter in "áéíóúçñšž")


def register(code: str, lookup: language.TextLookup, numbers: QLocale) -> None:
    """Add a language to those of the window."""
    translator = language._translator()
    translator.lookups[code], translator.locales[code] = lookup, numbers


@contextmanager
def spoken(code: str = CODE) -> Iterator[None]:
    """The window speaks it meanwhile, with German numbers and dates."""
    if code == CODE:
        register(CODE, lambda context, text: pseudo(text), QLocale("de_DE"))
    before = QLocale()
    language.set_window_language(code)
    try:
        yield
    finally:
        language.set_window_language("en")
        QLocale.setDefault(before)


def main() -> None:
    """Look at every state, and print what is cut and what was not translated."""
    from PySide6.QtWidgets import QApplication

    from carpus.ui.kit.fonts import load_fonts
    from tests.ui.gallery import STATES, Gallery
    from tests.ui.geometry import complaints, shown_texts

    application = QApplication.instance() or QApplication(["carpus"])
    assert isinstance(application, QApplication)
    application.setStyle("Fusion")
    load_fonts()
    code = sys.argv[1] if len(sys.argv) > 1 else CODE
    size_text, _, scale_text = (sys.argv[2] if len(sys.argv) > 2 else "1280x800@1.0").partition("@")
    width, height = map(int, size_text.split("x"))
    with spoken(code):
        gallery = Gallery(application, "light", (width, height), float(scale_text))
        for name in STATES:
            if len(sys.argv) > 3 and name not in sys.argv[3:]:
                continue
            gallery.show_state(name)
            for line in complaints(gallery.shell, may_elide=True):
                print(f"{name}: {line}")
            if code == CODE:
                for text in sorted({text for text in shown_texts(gallery.shell) if not is_pseudo(text)}):
                    print(f"{name}: plain: {text!r}")
        gallery.close()


if __name__ == "__main__":
    main()
