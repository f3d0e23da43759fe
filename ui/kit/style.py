"""Style sheet of Qt's own controls, made from the design tokens."""

from __future__ import annotations

from dataclasses import fields
from importlib.resources import as_file, files

from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QApplication

from carpus.ui.kit.fonts import font
from carpus.ui.kit.theme import CARD_RADIUS_PX, CONTROL_RADIUS_PX, DIM_ALPHA, FOCUS_OUTSIDE_PX, Theme

_SHEET = """
QLineEdit, QPlainTextEdit, QSpinBox, QDoubleSpinBox, QDateEdit, QComboBox, QKeySequenceEdit {{
  background: {surface}; color: {text}; border: 1px solid {border}; border-radius: 8px; padding: 0 {pad}px;
  selection-background-color: {accent}; selection-color: {on_accent}; min-height: {field}px;
  placeholder-text-color: {text2}; }}
QPlainTextEdit {{ padding: 8px; }}
QLineEdit:focus, QPlainTextEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QDateEdit:focus,
QComboBox:editable:focus {{
  border: 2px solid {accent}; padding: 0 {pad_focus}px; }}
QPlainTextEdit:focus {{ padding: 7px; }}
QComboBox {{ font-weight: 500; padding-right: 28px; }}
QComboBox:hover {{ background: {canvas}; }}
QDateEdit {{ padding-right: 28px; }}
QComboBox::drop-down, QDateEdit::drop-down {{ border: 0; width: 28px; subcontrol-position: center right; }}
QComboBox::down-arrow, QDateEdit::down-arrow {{ image: url({chevron}); width: 16px; height: 16px; }}
QComboBox QAbstractItemView {{ background: {surface}; color: {text}; border: 1px solid {border}; outline: 0;
  selection-background-color: {soft}; selection-color: {text}; padding: 4px; }}
QComboBox QAbstractItemView::item {{ min-height: {row}px; padding: 0 8px; }}
QCheckBox {{ color: {text}; spacing: 10px; min-height: {row}px; font-weight: 500; }}
QCheckBox:disabled {{ color: {border}; }}
QCheckBox::indicator {{ width: {box}px; height: {box}px; border: 2px solid {border}; border-radius: 4px;
  background: {surface}; }}
QCheckBox::indicator:hover {{ border-color: {accent}; }}
QCheckBox::indicator:checked {{ background: {accent}; border-color: {accent}; image: url({check}); }}
QCheckBox::indicator:disabled {{ border-color: {line}; }}
QSpinBox::up-button, QSpinBox::down-button {{ width: 0; border: 0; }}
QAbstractSpinBox QLineEdit, QComboBox QLineEdit {{ border: 0; background: transparent; min-height: 0; padding: 0; }}
QDoubleSpinBox::up-button, QDoubleSpinBox::down-button {{ width: 0; border: 0; }}
PageIndex {{ background: transparent; border: 0; outline: 0; font-weight: 500; }}
PageIndex::item {{ color: {text}; min-height: {page}px; padding: 0 12px; border-radius: 8px; }}
PageIndex::item:hover {{ background: {line}; }}
PageIndex::item:selected {{ background: {soft}; color: {text}; }}
QHeaderView::section {{ background: {canvas}; color: {text2}; border: 0; border-bottom: 1px solid {line};
  padding: 4px; }}
QScrollArea {{ border: 0; background: transparent; }}
QScrollArea > QWidget > QWidget {{ background: transparent; }}
QScrollBar:vertical {{ background: transparent; width: 12px; margin: 2px; }}
QScrollBar::handle:vertical {{ background: {border}; border-radius: 4px; min-height: 32px; }}
QScrollBar:horizontal {{ height: 0; }}
QScrollBar::add-line, QScrollBar::sub-line {{ width: 0; height: 0; }}
QScrollBar::add-page, QScrollBar::sub-page {{ background: transparent; }}
QProgressBar {{ background: {sunken}; border: 0; border-radius: 4px; min-height: 8px; max-height: 8px; }}
QProgressBar::chunk {{ background: {accent}; border-radius: 4px; }}
QToolTip {{ background: {text}; color: {surface}; border: 0; padding: 6px 8px; }}
QMenu {{ background: {surface}; color: {text}; border: 1px solid {border}; padding: 4px; }}
QMenu::item {{ padding: 8px 16px; border-radius: 4px; }}
QMenu::item:selected {{ background: {soft}; }}
Card {{ border-radius: {card}px; }}
Surface[thick="true"] {{ border-width: 2px; }}
Dialog {{ background: rgba(0, 0, 0, {dim}); }}
LockScreen {{ background: {canvas}; }}
QLineEdit QLabel {{ color: {text2}; }}
Surface#bar {{ border-radius: 2px; }}
Surface#badge {{ border-radius: {badge}px; }}
Surface#dot {{ border-radius: 6px; }}
RecordingPill {{ border-radius: {pill}px; }}
KeyCaps Surface {{ border-radius: 4px; }}
Option {{ background: {surface}; border: 1px solid {line}; border-radius: {card}px; }}
Option:hover {{ background: {canvas}; }}
Option:checked {{ background: {soft}; border: 2px solid {accent}; }}
MarkerRow {{ border: 0; border-left: 3px solid transparent; border-bottom: 1px solid {line}; }}
MarkerRow:checked {{ background: {soft}; border-left-color: {accent}; }}
Option QLabel#sentence, MarkerRow QLabel#value {{ color: {text2}; }}
FocusRing {{ border: 2px solid {accent}; border-radius: {ring}px; }}
"""
_TOKEN_RULES = """
Surface[fill="{name}"] {{ background: {value}; }}
Surface[edge="{name}"] {{ border: 1px solid {value}; }}
Surface[under="{name}"] {{ border-bottom: 1px solid {value}; }}
"""

_SHEET_TOKENS = ("surface", "text", "text2", "border", "accent", "on_accent", "soft", "sunken", "canvas", "line")


def apply_style(application: QApplication, theme: Theme) -> None:
    """Give the application the theme's palette, base font and style sheet."""
    tokens = theme.tokens
    palette = QPalette()
    pairs = {
        QPalette.ColorRole.Window: tokens.canvas, QPalette.ColorRole.WindowText: tokens.text,
        QPalette.ColorRole.Base: tokens.surface, QPalette.ColorRole.Text: tokens.text,
        QPalette.ColorRole.Button: tokens.surface, QPalette.ColorRole.ButtonText: tokens.text,
        QPalette.ColorRole.Highlight: tokens.accent, QPalette.ColorRole.HighlightedText: tokens.on_accent,
        QPalette.ColorRole.PlaceholderText: tokens.text2, QPalette.ColorRole.ToolTipBase: tokens.text,
        QPalette.ColorRole.ToolTipText: tokens.surface,
    }  # fmt: skip
    for role, value in pairs.items():
        palette.setColor(role, value)
    application.setPalette(palette)
    application.setFont(font(14 * theme.text_scale))
    colors = {name: getattr(tokens, name) for name in _SHEET_TOKENS}
    sizes = {
        "pad": 12, "pad_focus": 11, "field": theme.px(38), "row": theme.px(36), "box": theme.px(16),
        "page": theme.px(36), "card": CARD_RADIUS_PX,
        "ring": CONTROL_RADIUS_PX + FOCUS_OUTSIDE_PX, "badge": theme.px(34),
        "pill": theme.px(40) // 2, "dim": DIM_ALPHA[theme.name],
    }  # fmt: skip
    surfaces = "".join(_TOKEN_RULES.format(name=one.name, value=getattr(tokens, one.name)) for one in fields(tokens))
    with as_file(files("carpus.resources").joinpath("icons")) as icons:
        images = {
            "chevron": (icons / f"chevron-down-{theme.name}.svg").as_posix(),
            "check": (icons / f"check-{theme.name}.svg").as_posix(),
        }
        application.setStyleSheet(surfaces + _SHEET.format(**colors, **sizes, **images))
