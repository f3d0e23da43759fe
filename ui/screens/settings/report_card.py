"""Card of the settings with letterhead and paper size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, Qt, Signal
from PySide6.QtGui import QImage, QImageReader, QPixmap
from PySide6.QtWidgets import QCheckBox, QFileDialog, QLabel, QLineEdit, QPlainTextEdit

from carpus.core.results.report_form import MAX_ADDRESS_CHARACTERS, MAX_ADDRESS_LINES, MAX_NAME_CHARACTERS, ReportForm
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.forms import Field, Form
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr

ADDRESS_PX, LOGO_PX = 112, 56


class ReportCard(Card):
    """Letterhead, names and paper.

    Signals: ``changed`` with the :class:`ReportForm`.
    """

    changed = Signal(ReportForm)

    def __init__(self, theme: Theme, form: ReportForm) -> None:
        super().__init__(theme, 24)
        self._form = ReportForm()
        words = self.tr(
            "Name, address and logo of the clinic appear at the top of every page. Empty fields are not printed."
        )
        self.fields = Form(theme, self._make_fields(theme))
        self.logo_label = QLabel()
        self.logo_label.setAccessibleName(self.tr("Logo"))
        self.choose_button = Button(theme, self.tr("Choose a logo…"), height_px=40)
        self.remove_button = Button(theme, self.tr("Remove logo"), "quiet", height_px=40)
        self.error_text = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.error_text.hide()
        parts = self.fields.labelled_widgets
        self.add_heading(self.tr("Report"), words)
        fill(
            self.body,
            parts["name"],
            parts["address"],
            row_layout(self.logo_label, self.choose_button, self.remove_button, STRETCH, gap=12),
            self.error_text,
            (parts["prints_names"], 0, Qt.AlignmentFlag.AlignLeft),
            parts["paper"],
        )
        self.show_form(form)
        self.fields.changed.connect(self._apply_fields)
        self.choose_button.clicked.connect(self.choose_logo)
        self.remove_button.clicked.connect(lambda: self._set_logo(b""))

    def _make_fields(self, theme: Theme) -> list[Field]:
        address = QPlainTextEdit()
        address.setTabChangesFocus(True)
        theme.on_change(address, lambda: address.setFixedHeight(theme.px(ADDRESS_PX)))
        lines = self.tr("Address, up to four lines")
        papers = [("a4", "A4"), ("letter", self.tr("US Letter"))]
        name = QLineEdit(maxLength=MAX_NAME_CHARACTERS)
        names = QCheckBox(self.tr("Print real name, birth date and record number"))
        return [
            Field("name", self.tr("Clinic name"), name, change_signal="editingFinished"),
            Field(
                "address", lines, address, lambda text: lines if len(_address_lines(text)) > MAX_ADDRESS_LINES else ""
            ),
            Field("prints_names", "", names),
            Field("paper", self.tr("Paper"), ChoiceRow(theme, papers)),
        ]

    def show_form(self, form: ReportForm) -> None:
        """Show a form; what is being typed stays."""
        before, self._form = self._form, form
        self.fields.blockSignals(True)
        if form.letterhead != before.letterhead:
            self.fields["name"].setText(form.letterhead.name)
            self.fields["address"].setPlainText("\n".join(form.letterhead.address))
        self.fields["prints_names"].setChecked(form.prints_names)
        self.fields["paper"].choose(form.paper)
        self.fields.blockSignals(False)
        self._show_logo()

    def choose_logo(self) -> None:
        kinds = self.tr("Images (*.png *.jpg *.jpeg)")
        path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a logo"), "", kinds)
        if not path:
            return
        try:
            self._set_logo(logo_png(Path(path)))
        except LogoError as refused:
            self.error_text.show_text(str(refused))

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

    def _apply_fields(self) -> None:
        now = self.fields.values()
        self.fields.show_error("address", self.fields.find_error()[1])
        lines = tuple(_address_lines(now.pop("address"))[:MAX_ADDRESS_LINES])
        head = replace(self._form.letterhead, name=now.pop("name"), address=lines)
        self._change(replace(self._form, letterhead=head, **now))

    def _change(self, form: ReportForm) -> None:
        if form != self._form:
            self._form = form
            self.changed.emit(form)


def _address_lines(text: str) -> list[str]:
    return [line.strip()[:MAX_ADDRESS_CHARACTERS] for line in text.splitlines() if line.strip()]


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
