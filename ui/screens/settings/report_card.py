"""Card of the settings with letterhead and paper size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, Qt, Signal
from PySide6.QtGui import QImage, QImageReader, QPixmap
from PySide6.QtWidgets import QFileDialog, QLabel, QLineEdit, QPlainTextEdit

from carpus.core.results.report_form import MAX_ADDRESS_CHARACTERS, MAX_ADDRESS_LINES, MAX_NAME_CHARACTERS, ReportForm
from carpus.ui.kit.button import Button, CheckButton
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import ChoiceRow, LabelledField
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr

ADDRESS_PX, LOGO_PX = 112, 56


class ReportCard(Card):
    """Letterhead and paper.

    Signals: ``changed`` with the :class:`ReportForm`.
    """

    changed = Signal(ReportForm)

    def __init__(self, theme: Theme, form: ReportForm) -> None:
        super().__init__(theme, 24)
        self._theme, self._form = theme, form
        self.body.addWidget(Text(theme, self.tr("Report"), 20, SEMIBOLD))
        words = self.tr(
            "Name, address and logo of the clinic appear at the top of every page. Empty fields are not printed."
        )
        self.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.name = QLineEdit(form.letterhead.name, maxLength=MAX_NAME_CHARACTERS)
        self.address = QPlainTextEdit("\n".join(form.letterhead.address))
        self.address.setTabChangesFocus(True)
        theme.on_change(self.address, lambda: self.address.setFixedHeight(theme.px(ADDRESS_PX)))
        self.body.addWidget(LabelledField(theme, self.tr("Clinic name"), self.name))
        self.body.addWidget(LabelledField(theme, self.tr("Address, up to four lines"), self.address))
        row = row_layout(gap=12)
        self.logo_label = QLabel()
        self.logo_label.setAccessibleName(self.tr("Logo"))
        self.choose_button = Button(theme, self.tr("Choose a logo…"), height_px=40)
        self.remove_button = Button(theme, self.tr("Remove logo"), "quiet", height_px=40)
        fill(row, self.logo_label, self.choose_button, self.remove_button, STRETCH)
        self.body.addLayout(row)
        self.error_text = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.error_text.hide()
        self.names = CheckButton(theme, self.tr("Print real name, birth date and record number"))
        self.names.setChecked(form.prints_names)
        self.body.addWidget(self.names, 0, Qt.AlignmentFlag.AlignLeft)
        fill(self.body, self.error_text, Text(theme, self.tr("Paper"), 14, REGULAR, "text2"))
        self.paper = ChoiceRow(theme, [("a4", "A4"), ("letter", self.tr("US Letter"))], form.paper)
        self.body.addWidget(self.paper)
        self.name.editingFinished.connect(self._apply_letterhead)
        self.address.textChanged.connect(self._apply_letterhead)
        self.choose_button.clicked.connect(self.choose_logo)
        self.remove_button.clicked.connect(lambda: self._set_logo(b""))
        self.names.toggled.connect(lambda on: self._change(replace(self._form, prints_names=on)))
        self.paper.chosen.connect(lambda paper: self._change(replace(self._form, paper=paper)))
        self._show_logo()

    def show_form(self, form: ReportForm) -> None:
        self._form = form
        self.names.setChecked(form.prints_names)

    def choose_logo(self) -> None:
        kinds = self.tr("Images (*.png *.jpg *.jpeg)")
        path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a logo"), "", kinds)
        if path:
            self.load_logo(Path(path))

    def load_logo(self, path: Path) -> None:
        try:
            found = logo_png(path)
        except LogoError as refused:
            self.error_text.setText(str(refused))
            self.error_text.show()
            return
        self._set_logo(found)

    def _set_logo(self, png: bytes) -> None:
        self.error_text.hide()
        self._change(replace(self._form, letterhead=replace(self._form.letterhead, logo_png=png)))
        self._show_logo()

    def _show_logo(self) -> None:
        logo = QPixmap()
        logo.loadFromData(self._form.letterhead.logo_png)
        self.logo_label.setVisible(not logo.isNull())
        self.remove_button.setVisible(not logo.isNull())
        if not logo.isNull():
            mode = Qt.TransformationMode.SmoothTransformation
            self.logo_label.setPixmap(logo.scaled(3 * LOGO_PX, LOGO_PX, Qt.AspectRatioMode.KeepAspectRatio, mode))

    def _apply_letterhead(self) -> None:
        lines = [
            line.strip()[:MAX_ADDRESS_CHARACTERS] for line in self.address.toPlainText().splitlines() if line.strip()
        ]
        if len(lines) > MAX_ADDRESS_LINES:
            self.error_text.setText(self.tr("Address, up to four lines"))
        self.error_text.setVisible(len(lines) > MAX_ADDRESS_LINES)
        head = replace(self._form.letterhead, name=self.name.text().strip(), address=tuple(lines[:MAX_ADDRESS_LINES]))
        self._change(replace(self._form, letterhead=head))

    def _change(self, form: ReportForm) -> None:
        if form != self._form:
            self._form = form
            self.changed.emit(form)


MAX_LOGO_BYTES = 8_000_000
MAX_LOGO_PX = 1200
MIN_LOGO_PX = 32
MAX_LOGO_PIXELS = 40_000_000
LOGO_FORMATS = (b"png", b"jpeg")
"""SVG is excluded: it may load other files and take any time."""


class LogoError(ValueError):
    """Error that a picture cannot be a logo, with a message for the user."""


def logo_png(path: Path) -> bytes:
    """Return a logo as PNG, scaled down if very large.

    Raises :class:`LogoError`.
    """
    try:
        size = path.stat().st_size
        data = path.read_bytes() if size <= MAX_LOGO_BYTES else b""
    except OSError:
        raise LogoError(tr("This image cannot be read. Choose a PNG or JPEG file.")) from None
    if size > MAX_LOGO_BYTES:
        raise LogoError(tr("This image is larger than 8 MB. Choose a smaller one."))
    image = _decode_image(data)
    if image.isNull():
        raise LogoError(tr("Carpus cannot read this file as an image. Choose a PNG or JPEG file."))
    if min(image.width(), image.height()) < MIN_LOGO_PX:
        raise LogoError(tr("This image is too small to print. Choose one of at least 32 × 32 pixels."))
    if max(image.width(), image.height()) > MAX_LOGO_PX:
        image = image.scaled(
            MAX_LOGO_PX, MAX_LOGO_PX, Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
        )
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")  # type: ignore[call-overload]
    return bytes(store.data())


def _decode_image(data: bytes) -> QImage:
    store = QByteArray(data)
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.ReadOnly)
    reader = QImageReader(buffer)
    reader.setAutoTransform(True)
    reader.setDecideFormatFromContent(True)
    size = reader.size()  # as its head says, before anything is unpacked
    if bytes(reader.format().data()).lower() not in LOGO_FORMATS or size.width() * size.height() > MAX_LOGO_PIXELS:
        return QImage()
    return reader.read()
