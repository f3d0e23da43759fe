"""What is cut, overlaps or reaches outside on a window, found by geometry: of widgets, and of every text painted."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractScrollArea,
    QComboBox,
    QGraphicsView,
    QLabel,
    QLineEdit,
    QScrollArea,
    QWidget,
)

from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.text import ElidedText, Text
from carpus.ui.shell.main_window import FocusRing

ROOM_PX = 2.0
"""So much may lie outside or over another: the air that belongs to every letter."""


@dataclass(frozen=True, slots=True)
class Painted:
    """A text as it was painted: the box of its letters in the window, and what of the box can be seen."""

    text: str
    owner: QWidget
    box: QRectF
    seen: QRectF


@contextmanager
def painted_texts(window: QWidget) -> Iterator[list[Painted]]:
    """Collect what is painted by ``drawText`` on widgets of a window meanwhile."""
    found: list[Painted] = []
    original = QPainter.drawText

    def draw(painter: QPainter, *arguments: object) -> object:
        device = painter.device()
        text = next((one for one in arguments if isinstance(one, str)), "")
        if isinstance(device, QWidget) and device.window() is window and text.strip():
            metrics = QFontMetricsF(painter.font(), device)
            place = arguments[0]
            numbers = [one for one in arguments if isinstance(one, int | float | Qt.AlignmentFlag)]
            clip: QRectF | None = None
            if isinstance(place, QRectF | QRect):
                flags = next((one for one in arguments[1:] if not isinstance(one, str)), 0)
                flags = flags if isinstance(flags, int) else flags.value  # type: ignore[attr-defined]
                box = metrics.boundingRect(QRectF(place), flags, text)
                clip = None if flags & Qt.TextFlag.TextDontClip.value else QRectF(place)
            else:
                if isinstance(place, int | float):
                    start = QPointF(float(numbers[0]), float(numbers[1]))  # type: ignore[arg-type]
                else:
                    start = QPointF(place)  # type: ignore[call-overload]
                box = metrics.tightBoundingRect(text).translated(start)
            to_widget = painter.worldTransform()
            box = to_widget.mapRect(box)
            seen = QRectF(device.rect()) if clip is None else to_widget.mapRect(clip).intersected(QRectF(device.rect()))
            if painter.hasClipping():
                seen = seen.intersected(to_widget.mapRect(painter.clipBoundingRect()))
            shift = QPointF(device.mapTo(window, device.rect().topLeft()))
            found.append(Painted(text, device, box.translated(shift), seen.translated(shift)))
        return original(painter, *arguments)

    QPainter.drawText = draw  # type: ignore[method-assign, assignment]
    try:
        yield found
    finally:
        QPainter.drawText = original  # type: ignore[method-assign]


def complaints(window: QWidget, *, may_elide: bool = False) -> list[str]:
    """Everything that is cut, overlaps or reaches outside, one line each. ``may_elide``: texts and buttons may leave
    out the end of what they say, which their tooltip says in whole."""
    with painted_texts(window) as painted:
        window.grab()
    top = _topmost(window)
    texts = [one for one in painted if _belongs(one.owner, top)]
    texts += [one for one in _labels(window) if _belongs(one.owner, top)]
    elided = [] if may_elide else _elided(texts)
    return [
        *elided,
        *_cut(texts),
        *_overlapping(texts),
        *_crossing(window, top),
        *_outside(window, top),
        *_small(window, top, may_elide),
    ]


def lettered(window: QWidget) -> list[str]:
    """The texts to be seen that have an underlined letter: of the topmost sheet, or of the whole window."""
    top = _topmost(window)
    widgets = [*window.findChildren(QAbstractButton), *(one for one in window.findChildren(QLabel) if one.buddy())]
    texts = [one.text() for one in widgets if one.isVisible() and _belongs(one, top)]
    return [text for text in texts if letter_of(text)]


def letter_of(text: str) -> str:
    """The underlined letter of a text; empty for none."""
    found = re.search(r"(?<!&)&(\w)", text)
    return found[1].lower() if found else ""


def shown_texts(window: QWidget) -> list[str]:
    """Every text that is painted, or said by a tooltip or a name for those who do not see."""
    with painted_texts(window) as painted:
        window.grab()
    texts = [one.text for one in (*painted, *_labels(window))]
    for widget in window.findChildren(QWidget):
        if widget.isVisible():
            texts += [widget.toolTip(), widget.accessibleName(), widget.accessibleDescription()]
    return [text for text in texts if re.search(r"[A-Za-z]{3}", text)]


def _topmost(window: QWidget) -> QWidget | None:
    """The sheet that covers all else, if there is one."""
    sheets = [sheet for sheet in window.findChildren(Dialog) if sheet.isVisible()]
    return sheets[-1] if sheets else None


def _belongs(widget: QWidget, top: QWidget | None) -> bool:
    return top is None or top.isAncestorOf(widget)


def _labels(window: QWidget) -> list[Painted]:
    """Labels that Qt paints itself."""
    found = []
    for label in window.findChildren(QLabel):
        paints_itself = type(label).paintEvent not in (QLabel.paintEvent, Text.paintEvent)
        if isinstance(label, Text) and label.visible_text != label.text():
            continue  # elided, and found as it is painted
        if paints_itself or not label.isVisible() or not label.text().strip():
            continue
        metrics, inside = QFontMetricsF(label.font()), QRectF(label.contentsRect())
        flags = label.alignment().value | (Qt.TextFlag.TextWordWrap.value if label.wordWrap() else 0)
        box = metrics.boundingRect(inside, flags, label.text())
        shift = QPointF(label.mapTo(window, label.rect().topLeft()))
        found.append(Painted(label.text(), label, box.translated(shift), QRectF(label.rect()).translated(shift)))
    return found


def _scrolled(widget: QWidget) -> QAbstractScrollArea | None:
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            return parent
        parent = parent.parentWidget()
    return None


def _cut(texts: list[Painted]) -> list[str]:
    out = []
    for one in texts:
        over = one.box.united(one.seen)
        wide = over.width() - one.seen.width()
        high = over.height() - one.seen.height() - 0.35 * one.box.height()  # air above and below capitals
        if wide > ROOM_PX or high > 0.0:
            out.append(f"cut: {one.text!r} by {wide:.0f}x{max(high, 0.0):.0f} px in {_name(one.owner)}")
    return out


def _elided(texts: list[Painted]) -> list[str]:
    return [
        f"cut: {one.owner.text()!r} to {one.text!r}"
        for one in texts
        if isinstance(one.owner, Text | Button) and not isinstance(one.owner, ElidedText)
        if one.text.endswith("…") and one.text != one.owner.text()
    ]  # fmt: skip


def _overlapping(texts: list[Painted]) -> list[str]:
    out = []
    seen = [(one, one.box.intersected(one.seen)) for one in texts]
    shown = [(one, box) for one, box in seen if not box.isEmpty()]
    for number, (one, box) in enumerate(shown):
        for other, other_box in shown[number + 1 :]:
            if not box.intersects(other_box):
                continue
            if one.owner is other.owner and one.text == other.text:
                continue  # a halo, or a repeated painting of the same widget
            if _hidden_from(one.owner, other.owner):
                continue
            common = box.intersected(other_box)
            least = 0.35 * min(one.box.height(), other.box.height())
            if common.width() > ROOM_PX and common.height() > max(least, ROOM_PX):
                where = f"{_name(one.owner)}, {_name(other.owner)}"
                out.append(f"over: {one.text!r} and {other.text!r} in {where}")
    return sorted(set(out))


def _hidden_from(one: QWidget, other: QWidget) -> bool:
    """Whether what is scrolled away of one lies where the other is seen."""
    first, second = _scrolled(one), _scrolled(other)
    return first is not second and (first is not None or second is not None)


def _crossing(window: QWidget, top: QWidget | None) -> list[str]:
    """Neighbours in one parent that lie over each other."""
    out = []
    for parent in (window, *window.findChildren(QWidget)):
        if not parent.isVisible() or not _belongs(parent, top) or isinstance(parent, QGraphicsView):
            continue
        children = [
            child
            for child in parent.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
            if child.isVisible() and not child.isWindow() and not isinstance(child, Dialog | FocusRing)
            and not child.property("floats")
        ]  # fmt: skip
        for number, child in enumerate(children):
            for other in children[number + 1 :]:
                common = child.geometry().intersected(other.geometry())
                if common.width() > ROOM_PX and common.height() > ROOM_PX:
                    out.append(f"crossing: {_name(child)} and {_name(other)} by {common.width()}x{common.height()} px")
    return out


def _outside(window: QWidget, top: QWidget | None) -> list[str]:
    """Widgets that reach out of their parent."""
    out = []
    for widget in window.findChildren(QWidget):
        parent = widget.parentWidget()
        if parent is None or not widget.isVisible() or widget.isWindow() or not _belongs(widget, top):
            continue
        if isinstance(widget, FocusRing) or widget.size().isEmpty():
            continue
        if isinstance(parent.parentWidget(), QAbstractScrollArea):
            continue  # may be as high as it likes; scrolled
        if not parent.rect().adjusted(-2, -2, 2, 2).contains(widget.geometry()):
            out.append(f"outside: {_name(widget)} {widget.geometry().getRect()} of {parent.rect().getRect()[2:]}")
    return out


def _small(window: QWidget, top: QWidget | None, may_elide: bool) -> list[str]:
    """Buttons and fields with less room than their words need."""
    out = []
    for widget in window.findChildren(QWidget):
        if not widget.isVisible() or not _belongs(widget, top):
            continue
        needed = 0.0
        if isinstance(widget, Button | QComboBox) and may_elide:
            continue
        if isinstance(widget, QAbstractButton) and widget.text():
            needed = widget.minimumSizeHint().width()
        elif isinstance(widget, QComboBox):
            needed = QFontMetricsF(widget.font()).horizontalAdvance(widget.currentText()) + 24
        elif isinstance(widget, QLineEdit) and not widget.text():
            needed = QFontMetricsF(widget.font()).horizontalAdvance(widget.placeholderText()) + 8
        if widget.width() + ROOM_PX < needed:
            out.append(f"small: {_name(widget)} is {widget.width()} px wide, needs {needed:.0f}")
    return out


def _name(widget: QWidget) -> str:
    said = getattr(widget, "text", None)
    words = said() if callable(said) else widget.accessibleName()
    parent = widget.parentWidget()
    return f"{type(parent).__name__}/{type(widget).__name__}({str(words)[:40]!r})"
