"""Translation outside widgets: texts of functions share the empty context, as ``lupdate`` files them."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from carpus.core.phrase import Phrase


def tr(text: str) -> str:
    """The text in the person's language. Widgets use ``self.tr``, whose context is their class."""
    return QCoreApplication.translate("", text)


def say(text: str) -> str:
    """A phrase of core in the person's language, its facts in their places; any other text as it is."""
    if not isinstance(text, Phrase):
        return text
    template = QCoreApplication.translate("", text.template)
    if not text.facts:
        return template
    return template.format(**{name: say(fact) if isinstance(fact, str) else fact for name, fact in text.facts.items()})
