"""Plots of an agreement: both curves over time and the differences with their limits, as PNG and PDF. No window."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPageLayout, QPageSize, QPainter, QPdfWriter

from carpus.core.formats.new_output import new_bytes
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.plot.agreement import AgreementChart, AgreementPlot
from carpus.ui.plot.style import paper_style
from carpus.ui.report.pdf import ensure_application
from carpus.ui.theme import LIGHT, Theme
from carpus.ui.translate import say, tr
from carpus.ui.words.agreement import angle_name, remark_words, share, tenths

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.compare import Compared, Pairs

WIDTH, HEIGHT = 1120.0, 480.0
PICTURE_SCALE = 2
REMARK = Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
POINT_PX = 4.0 / 3.0
"""Painter units a point: the page is drawn in design pixels."""


def write_plots(compared: Compared, folder: Path, stem: str, limit_deg: float = 0.0) -> list[Path]:
    """Write one ``STEM.ANGLE.png`` for each angle and ``STEM.pdf`` with all; the files. ``limit_deg``
    set before is hatched, 0 for none.

    Raises :class:`OutputExists` or :class:`OutputNotWritable`.
    """
    application = ensure_application()
    out = []
    for pairs in compared.pairs:
        picture = QImage(int(WIDTH) * PICTURE_SCALE, int(HEIGHT) * PICTURE_SCALE, QImage.Format.Format_RGB32)
        picture.fill(QColor("white"))
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.scale(PICTURE_SCALE, PICTURE_SCALE)
        _paint(painter, pairs, compared, limit_deg)
        painter.end()
        store = QByteArray()
        buffer = QBuffer(store)
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        picture.save(buffer, "PNG")  # type: ignore[call-overload]
        buffer.close()
        out.append(_stored(folder / f"{stem}.{pairs.name}.png", bytes(store.data())))
    out.append(_stored(folder / f"{stem}.pdf", _pdf(compared, limit_deg)))
    del application
    return out


def _stored(path: Path, content: bytes) -> Path:
    with new_bytes(path) as file:
        file.write(content)
    return path


def _pdf(compared: Compared, limit_deg: float) -> bytes:
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(1200)
    page = QPageSize(QPageSize.PageSizeId.A4)
    writer.setPageLayout(QPageLayout(page, QPageLayout.Orientation.Landscape, QMarginsF(10, 10, 10, 10)))
    writer.setTitle("Carpus agreement")
    painter = QPainter(writer)
    scale = writer.width() / WIDTH
    for k, pairs in enumerate(compared.pairs):
        if k:
            writer.newPage()
        painter.save()
        painter.scale(scale, scale)
        _paint(painter, pairs, compared, limit_deg)
        painter.restore()
    painter.end()
    buffer.close()
    return bytes(store.data())


def _paint(painter: QPainter, pairs: Pairs, compared: Compared, limit_deg: float) -> None:
    f = pairs.figures_deg
    painter.setPen(QColor(LIGHT.text))
    painter.setFont(font(20, SEMIBOLD))
    painter.drawText(QPointF(24, 34), angle_name(pairs.name))
    painter.setFont(font(13))
    said = [
        f"RMSE {tenths(f.rmse)}",
        f"r {share(f.correlation)}",
        f"ICC(2,1) {share(f.icc)}",
        f"ICC(3,1) {share(f.icc_3_1)}",
    ]
    if math.isfinite(f.cmc):
        said.append(f"CMC {share(f.cmc)}")
    words = (
        tr("{count} pairs, {kind}") if compared.pictures == 0 else tr("{count} pairs of one session, against {kind}")
    )
    said.append(words.format(count=f.count, kind=say(compared.kind)))
    painter.drawText(QPointF(24, 58), "   ".join(said))
    top = 84.0
    for words in remark_words(compared, pairs.name):
        painter.setPen(QColor(LIGHT.warn))
        box = painter.boundingRect(QRectF(24, top - 16, WIDTH - 48, 200), REMARK, words)
        painter.drawText(box, REMARK, words)
        top = box.bottom() + 20.0
    style, over_time = paper_style(POINT_PX), compared.shift is not None
    plot = AgreementPlot(pairs, limit_deg, over_time, "curves")
    height = HEIGHT - 24.0 - top
    both = (plot, QRectF(24, top, 500, height)), (replace(plot, view="differences"), QRectF(548, top, 556, height))
    for shown, box in both:
        chart = AgreementChart(Theme("light"), shown)
        chart.paint_on(painter, style, box)
        chart.deleteLater()
