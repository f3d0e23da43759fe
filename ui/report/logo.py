"""A clinic's logo: a picture that a person chose becomes the PNG that reports are printed with."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, Qt
from PySide6.QtGui import QImage, QImageReader

from carpus.ui.translate import tr

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
