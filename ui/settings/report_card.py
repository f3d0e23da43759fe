"""The clinic's letterhead and paper as a card of the settings."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, Qt, Signal
from PySide6.QtGui import QImage, QImageReader, QPixmap
from PySide6.QtWidgets import QFileDialog, QLabel, QLineEdit, QPlainTextEdit

from carpus.core.results.report_form import MOST_ADDRESS, MOST_ADDRESS_LINES, MOST_NAME, ReportForm
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.field import Choices, Labelled
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

ADDRESS_PX, LOGO_PX = 112, 56


class ReportCard(Card):
    """``changed`` carries the whole :class:`ReportForm`."""

    changed = Signal(ReportForm)

    def __init__(self, theme: Theme, form: ReportForm) -> None:
        super().__init__(theme, 24)
        self._theme, self._form = theme, form
        self.body.addWidget(Text(theme, self.tr("Report"), 20, SEMIBOLD))
        words = self.tr("Name, address and logo of the clinic stand above every page. Left empty, nothing is printed.")
        self.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.name = QLineEdit(form.letterhead.name, maxLength=MOST_NAME)
        self.address = QPlainTextEdit("\n".join(form.letterhead.address))
        self.address.setTabChangesFocus(True)
        theme.follow(self.address, lambda: self.address.setFixedHeight(theme.px(ADDRESS_PX)))
        self.body.addWidget(Labelled(theme, self.tr("Name of the clinic"), self.name))
        self.body.addWidget(Labelled(theme, self.tr("Address, up to four lines"), self.address))
        row = in_line(gap=12)
        self.picture = QLabel()
        self.picture.setAccessibleName(self.tr("Logo"))
        self.choose = Button(theme, self.tr("Choose a logo…"), height_px=40)
        self.remove = Button(theme, self.tr("Remove the logo"), "quiet", height_px=40)
        fill(row, self.picture, self.choose, self.remove, STRETCH)
        self.body.addLayout(row)
        self.problem = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.problem.hide()
        fill(self.body, self.problem, Text(theme, self.tr("Paper"), 14, REGULAR, "text2"))
        self.paper = Choices(theme, [("a4", "A4"), ("letter", self.tr("US Letter"))], form.paper)
        self.body.addWidget(self.paper)
        self.name.editingFinished.connect(self._take)
        self.address.textChanged.connect(self._take)
        self.choose.clicked.connect(self.ask_logo)
        self.remove.clicked.connect(lambda: self._take_logo(b""))
        self.paper.chosen.connect(lambda paper: self._change(replace(self._form, paper=paper)))
        self._show_logo()

    def show_form(self, form: ReportForm) -> None:
        self._form = form

    def ask_logo(self) -> None:
        kinds = self.tr("Pictures (*.png *.jpg *.jpeg)")
        path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a logo"), "", kinds)
        if path:
            self.take_picture(Path(path))

    def take_picture(self, path: Path) -> None:
        try:
            found = logo_png(path)
        except LogoRefused as refused:
            self.problem.setText(str(refused))
            self.problem.show()
            return
        self._take_logo(found)

    def _take_logo(self, png: bytes) -> None:
        self.problem.hide()
        self._change(replace(self._form, letterhead=replace(self._form.letterhead, logo_png=png)))
        self._show_logo()

    def _show_logo(self) -> None:
        logo = QPixmap()
        logo.loadFromData(self._form.letterhead.logo_png)
        self.picture.setVisible(not logo.isNull())
        self.remove.setVisible(not logo.isNull())
        if not logo.isNull():
            mode = Qt.TransformationMode.SmoothTransformation
            self.picture.setPixmap(logo.scaled(3 * LOGO_PX, LOGO_PX, Qt.AspectRatioMode.KeepAspectRatio, mode))

    def _take(self) -> None:
        lines = [line.strip()[:MOST_ADDRESS] for line in self.address.toPlainText().splitlines() if line.strip()]
        if len(lines) > MOST_ADDRESS_LINES:
            self.problem.setText(self.tr("Address, up to four lines"))
        self.problem.setVisible(len(lines) > MOST_ADDRESS_LINES)
        head = replace(self._form.letterhead, name=self.name.text().strip(), address=tuple(lines[:MOST_ADDRESS_LINES]))
        self._change(replace(self._form, letterhead=head))

    def _change(self, form: ReportForm) -> None:
        if form != self._form:
            self._form = form
            self.changed.emit(form)


MOST_BYTES = 8_000_000
LONGEST_PX = 1200
LEAST_PX = 32
MOST_PIXELS = 40_000_000
KINDS = (b"png", b"jpeg")
"""A drawing (SVG) is a program of its own: it may load other files and take any time."""


class LogoRefused(ValueError):
    """The picture cannot be a logo; its words say why, for the person."""


def logo_png(path: Path) -> bytes:
    """The picture as a PNG, made smaller where it is very large. Raises :class:`LogoRefused` with one sentence."""
    try:
        size = path.stat().st_size
        data = path.read_bytes() if size <= MOST_BYTES else b""
    except OSError:
        raise LogoRefused(tr("This picture cannot be read. Choose a PNG or JPEG file.")) from None
    if size > MOST_BYTES:
        raise LogoRefused(tr("This picture is larger than 8 MB. Choose a smaller one."))
    image = _of_pixels(data)
    if image.isNull():
        raise LogoRefused(tr("This file is no picture that Carpus can read. Choose a PNG or JPEG file."))
    if min(image.width(), image.height()) < LEAST_PX:
        raise LogoRefused(tr("This picture is too small to print. Choose one of at least 32 pixels each way."))
    if max(image.width(), image.height()) > LONGEST_PX:
        image = image.scaled(
            LONGEST_PX, LONGEST_PX, Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
        )
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")  # type: ignore[call-overload]
    return bytes(store.data())


def _of_pixels(data: bytes) -> QImage:
    store = QByteArray(data)
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.ReadOnly)
    reader = QImageReader(buffer)
    reader.setAutoTransform(True)
    reader.setDecideFormatFromContent(True)
    size = reader.size()  # as its head says, before anything is unpacked
    if bytes(reader.format().data()).lower() not in KINDS or size.width() * size.height() > MOST_PIXELS:
        return QImage()
    return reader.read()
