"""Translation outside widgets: texts of functions share the empty context, as ``lupdate`` files them."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


def tr(text: str) -> str:
    """The text in the person's language. Widgets use ``self.tr``, whose context is their class."""
    return QCoreApplication.translate("", text)
