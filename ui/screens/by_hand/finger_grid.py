"""Goniometer grid of fingers and joints, active and passive, filled by keyboard in one go."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import date

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QAbstractItemView,
    QHeaderView,
    QLineEdit,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from carpus.core.measures.manual_measurements import (
    BOTH_MODES,
    FINGER_JOINTS,
    ManualMeasure,
    ManualValue,
    MeasureKey,
    Mode,
    compute_total_deg,
    current_values,
    find_latest_entries,
    find_manual_measure,
)
from carpus.core.model.types import Side
from carpus.core.results.manual_proposals import CellKey
from carpus.core.results.measure import Measure
from carpus.ui.kit import numbers
from carpus.ui.kit.field import SHOWN_DIGITS, parse_number
from carpus.ui.kit.text import REGULAR, SEMIBOLD
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.words.manual_values import entry_error, entry_warning, full_name, history_words, mode_name, value_words
from carpus.ui.words.ranges import LOWER_BOUND
from carpus.ui.words.terms import finger_name

ROW_PX, HEAD_PX = 30, 46
JOINT_COLUMNS = ("MCP", "PIP", "DIP")
TOTAL_COLUMN, PALM_COLUMN = 6, 7


class FingerCell(QTableWidgetItem):
    """Cell of one measure and mode: what was typed, else what Carpus measured or what follows from other cells."""

    def __init__(self, theme: Theme, measure: ManualMeasure | None, mode: Mode) -> None:
        super().__init__()
        self._theme, self.measure = theme, measure
        self.name = full_name((measure.id, mode, "")) if measure else ""
        self.is_entry = measure is not None and not measure.id.startswith("TAM")
        self.measured: Measure | None = None
        self.total = ""
        self.is_measured = False
        """True if what it shows is Carpus's, or has a part of it."""
        self.note = ""
        if not self.is_entry:
            self.setFlags(Qt.ItemFlag.ItemIsEnabled if measure else Qt.ItemFlag.NoItemFlags)
        self.setTextAlignment(Qt.AlignmentFlag.AlignCenter)

    @property
    def typed_text(self) -> str:
        return str(super().data(Qt.ItemDataRole.EditRole) or "").strip()

    @property
    def error(self) -> str:
        return entry_error(self.measure, parse_number(self.typed_text)) if self.measure and self.typed_text else ""

    @property
    def warning(self) -> str:
        return entry_warning(self.measure, parse_number(self.typed_text)) if self.measure and self.typed_text else ""

    @property
    def number(self) -> float:
        """Number typed, else measured by Carpus; NaN if it is neither or wrong."""
        if self.typed_text:
            return math.nan if self.error else parse_number(self.typed_text)
        return self.measured.mean if self.measured is not None else math.nan

    @property
    def is_lower_bound(self) -> bool:
        return self.measured is not None and not self.typed_text and self.measured.is_lower_bound

    def data(self, role: int) -> object:
        roles, color = Qt.ItemDataRole, self._theme.color
        if role == roles.DisplayRole:
            if self.measured is None or self.typed_text:
                return self.total or self.typed_text
            return _degrees(self.measured.mean, self.is_lower_bound)
        if role == roles.FontRole:
            face = self._theme.font(14, REGULAR if self.is_entry else SEMIBOLD)
            face.setItalic(self.is_measured)
            return face
        if role == roles.BackgroundRole:
            empty = "surface" if self.measure else "canvas"
            return color(
                "bad_soft" if self.error else "warn_soft" if self.warning else "soft" if self.is_measured else empty
            )
        if role in (roles.ToolTipRole, roles.AccessibleDescriptionRole):
            return "\n".join(filter(None, (self.name, self.error or self.warning, self.note)))
        return super().data(role)


class _LiveDelegate(QStyledItemDelegate):
    """Takes over each digit at once, so that the totals follow."""

    def createEditor(
        self, parent: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QWidget:
        editor = super().createEditor(parent, option, index)
        if isinstance(editor, QLineEdit):
            editor.setMaxLength(8)
            editor.setAlignment(Qt.AlignmentFlag.AlignCenter)
            editor.setStyleSheet("min-height: 0; padding: 0; border-radius: 0;")
            editor.textEdited.connect(lambda _: self.commitData.emit(editor))
            editor.setProperty("text_before", index.data(Qt.ItemDataRole.EditRole))
        return editor


class FingerGrid(QTableWidget):
    """Grid of fingers and joints; Enter and Tab move on, a digit starts an entry.

    Carpus's values are shown in empty cells and count in the totals, but are never saved as manual ones.

    Signals: ``edited`` with the measure's name.
    """

    edited = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(len(BOTH_MODES) * len(FINGER_JOINTS), PALM_COLUMN + 1)
        self._theme = theme
        self.setHorizontalHeaderLabels(_column_heads())
        self.setVerticalHeaderLabels(
            [f"{finger_name(str(finger))}, {mode_name(mode)}" for mode in BOTH_MODES for finger in FINGER_JOINTS]
        )
        self.cells: dict[CellKey, FingerCell] = {}
        for row, (mode, finger) in enumerate((mode, finger) for mode in BOTH_MODES for finger in FINGER_JOINTS):
            for column in range(self.columnCount()):
                name = _measure_id(finger, mode, column)
                cell = FingerCell(theme, find_manual_measure(name) if name else None, mode)
                self.setItem(row, column, cell)
                if name:
                    self.cells[name, mode] = cell
        self.setItemDelegate(_LiveDelegate(self))
        self.setEditTriggers(
            QAbstractItemView.EditTrigger.AnyKeyPressed
            | QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
        )
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setSectionsClickable(False)
            header.setHighlightSections(False)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName(self.tr("Finger joints, goniometer"))
        self.itemChanged.connect(self._on_edited)
        theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        theme = self._theme
        line, canvas = theme.tokens.line, theme.tokens.canvas
        corner = f"QTableCornerButton::section {{ background: {canvas}; border: 0; }}"
        self.setStyleSheet(f"QTableWidget {{ gridline-color: {line}; }} {corner}")
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setFont(theme.font(12, REGULAR))
        self.horizontalHeader().setFixedHeight(theme.px(HEAD_PX))
        self.verticalHeader().setDefaultSectionSize(theme.px(ROW_PX))
        self.setFixedHeight(theme.px(HEAD_PX) + theme.px(ROW_PX) * self.rowCount() + 4)

    # --- what is shown ------------------------------------------------------------------------------------
    def show_values(
        self, values: Sequence[ManualValue], side: Side, day: date, measured: Mapping[CellKey, Measure]
    ) -> None:
        self.blockSignals(True)
        kept = find_latest_entries(values)
        previous = {one.key: one for one in current_values(values) if one.day < day}
        for (name, mode), cell in self.cells.items():
            key: MeasureKey = name, mode, side
            cell.measured = measured.get((name, mode))
            notes = [self.tr("Measured by Carpus on this day")] if cell.measured else []
            if last := previous.get(key):
                value = value_words(find_manual_measure(name), last.value)
                notes.append(f"{numbers.format_day_month(last.day)}: {value}")
            cell.note = "\n".join(filter(None, (*notes, history_words(values, [key], day))))
            if cell.is_entry:
                stored = kept.get((key, day))
                shown = numbers.format_significant(stored.value, SHOWN_DIGITS) if stored and stored.trials else ""
                cell.setText(shown.replace("-", "\N{MINUS SIGN}"))
        self._update_totals()
        self.blockSignals(False)

    def keys(self, side: Side) -> list[MeasureKey]:
        return [(name, mode, side) for (name, mode), cell in self.cells.items() if cell.is_entry]

    def read_values(self, side: Side, day: date) -> list[ManualValue]:
        """Return one value per cell, without trials if nothing was typed.

        Raises ValueError for an invalid entry.
        """
        cells = [(key, self.cells[key[0], key[1]]) for key in self.keys(side)]
        return [
            ManualValue(*key, day, (parse_number(cell.typed_text),) if cell.typed_text else ())  # type: ignore[arg-type]
            for key, cell in cells
        ]

    def list_errors(self) -> list[str]:
        return [f"{cell.name}: {cell.error}" for cell in self.cells.values() if cell.error]

    def list_warnings(self) -> list[str]:
        return [f"{cell.name}: {cell.warning}" for cell in self.cells.values() if cell.warning]

    def _update_totals(self) -> None:
        """Work out TAM and TPM of each finger whose joints are all known."""
        for cell in self.cells.values():
            cell.is_measured = cell.measured is not None and not cell.typed_text
        for mode in BOTH_MODES:
            for finger, joints in FINGER_JOINTS.items():
                parts = {
                    name: self.cells[name, mode]
                    for name in (f"{joint}_{end}" for joint in joints for end in ("FLEXION", "EXTENSION"))
                }
                total_deg = compute_total_deg(finger, {name: cell.number for name, cell in parts.items()})
                cell = self.cells[f"TAM{finger}", mode]
                cell.total = _degrees(total_deg, any(part.is_lower_bound for part in parts.values()))
                cell.is_measured = math.isfinite(total_deg) and any(part.is_measured for part in parts.values())
        self.viewport().update()

    def _on_edited(self, cell: QTableWidgetItem) -> None:
        self._update_totals()
        if isinstance(cell, FingerCell) and cell.measure is not None:
            self.edited.emit(cell.measure.id)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        if self.currentItem() is None:
            self.setCurrentCell(0, 0)

    # --- keyboard -----------------------------------------------------------------------------------------
    def focusNextPrevChild(self, next: bool) -> bool:
        """Move to the next cell; from the last one on to the next field."""
        return self._step(1 if next else -1) or super().focusNextPrevChild(next)

    def _step(self, step: int) -> bool:
        place = self.currentRow() * self.columnCount() + self.currentColumn() + step
        while 0 <= place < self.rowCount() * self.columnCount():
            row, column = divmod(place, self.columnCount())
            cell = self.item(row, column)
            if isinstance(cell, FingerCell) and cell.is_entry:
                self.setCurrentCell(row, column)
                return True
            place += step
        return False

    def closeEditor(self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint) -> None:
        """Move on after Enter and Tab, so that the arrow keys work again; Esc restores what was there."""
        hints = QAbstractItemDelegate.EndEditHint
        super().closeEditor(editor, hints.NoHint)
        if hint == hints.RevertModelCache:
            self.currentItem().setText(editor.property("text_before") or "")
        if hint in (hints.SubmitModelCache, hints.EditNextItem, hints.EditPreviousItem):
            forward = hint != hints.EditPreviousItem
            if not self._step(1 if forward else -1):
                super().focusNextPrevChild(forward)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        keys, cell = Qt.Key, self.currentItem()
        if self.state() == QAbstractItemView.State.EditingState and event.key() in (keys.Key_Return, keys.Key_Enter):
            event.ignore()  # the editor's, which closes and moves on
            return
        plain = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier == Qt.KeyboardModifier.NoModifier
        if plain and event.key() in (keys.Key_Return, keys.Key_Enter):
            self.focusNextPrevChild(True)
        elif plain and event.key() in (keys.Key_Delete, keys.Key_Backspace) and isinstance(cell, FingerCell):
            if cell.is_entry:
                cell.setText("")
        elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            event.ignore()  # the screen saves with Ctrl+Enter
        else:
            super().keyPressEvent(event)


def _column_heads() -> list[str]:
    joints = (tr("MCP"), tr("PIP"), f"{tr('DIP')} ({tr('IP')})")
    ends = [f"{joint}\n{end}" for joint in joints for end in (tr("ext."), tr("flex."))]
    return [*ends, "TAM\nTPM", tr("Tip to\npalm, cm")]


def _degrees(value_deg: float, is_lower_bound: bool) -> str:
    words = numbers.format_signed_degrees(value_deg).removesuffix("°")
    return f"{LOWER_BOUND}{words}" if is_lower_bound and math.isfinite(value_deg) else words


def _measure_id(finger: int, mode: Mode, column: int) -> str:
    """Return the measure of a cell, empty if the thumb has no such joint, or nothing is measured passively."""
    if column == TOTAL_COLUMN:
        return f"TAM{finger}"
    if column == PALM_COLUMN:
        return f"TIP_TO_PALM{finger}" if finger > 1 and mode == "active" else ""
    joint, end = JOINT_COLUMNS[column // 2], ("EXTENSION", "FLEXION")[column % 2]
    if finger == 1:
        joint = {"MCP": "MCP", "DIP": "IP"}.get(joint, "")
    return f"{joint}{finger}_{end}" if joint else ""
