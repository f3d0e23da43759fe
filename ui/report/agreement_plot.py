"""Agreement plots as PNG and PDF: differences against their mean (Bland and Altman), and both curves over time."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QSizeF
from PySide6.QtGui import QColor, QImage, QPainter

from carpus.core.formats.output_files import open_new_file
from carpus.ui.charts.agreement import CurveChart, DifferenceChart
from carpus.ui.charts.panel import paper_style
from carpus.ui.kit.text import SEMIBOLD
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.report.page import (
    POINTS_PER_MM,
    UNIT,
    chart_part,
    column,
    ensure_application,
    fit_parts,
    line,
    paragraph,
    pdf_bytes,
    render_parts,
)
from carpus.ui.words.agreement import (
    angle_name,
    format_coefficient,
    format_tenths,
    remark_words,
)

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.research.agreement.compare import AnglePairs, Comparison

WIDTH, HEIGHT, EDGE = 1120, 480, 24
PICTURE_SCALE = 2
PAPER_MM, MARGIN_MM = (297.0, 210.0), 10.0
# The page is laid out in design pixels, not in points.
STYLE = paper_style(4.0 / 3.0 * UNIT)
PaintPlots = Callable[[QPainter, float], None]


def write_plots(compared: Comparison, folder: Path, stem: str, limit_deg: float = 0.0) -> list[Path]:
    """Write ``STEM.ANGLE.png`` for each angle and ``STEM.pdf`` with all of them.

    ``limit_deg``, the acceptance limit set beforehand, is hatched; 0 for none.

    Raises
    ------
    OutputExists, OutputNotWritable
            If a file exists already, or the folder cannot be written.
    """
    application = ensure_application()
    pages = {pairs.name: _page_painter(pairs, compared, limit_deg) for pairs in compared.pairs}
    out = [_write_file(folder / f"{stem}.{name}.png", _picture(paint)) for name, paint in pages.items()]
    on_paper = [(QSizeF(*PAPER_MM), partial(_paint_on_paper, paint)) for paint in pages.values()]
    out.append(_write_file(folder / f"{stem}.pdf", pdf_bytes(on_paper, "Carpus agreement")))
    del application
    return out


def _write_file(path: Path, content: bytes) -> Path:
    with open_new_file(path) as file:
        file.write(content)
    return path


def _picture(paint: PaintPlots) -> bytes:
    picture = QImage(WIDTH * PICTURE_SCALE, HEIGHT * PICTURE_SCALE, QImage.Format.Format_RGB32)
    picture.fill(QColor("white"))
    with QPainter(picture) as painter:
        paint(painter, PICTURE_SCALE)
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    picture.save(buffer, "PNG")  # type: ignore[call-overload]
    return bytes(store.data())


def _paint_on_paper(paint: PaintPlots, painter: QPainter, point: float) -> None:
    mm = POINTS_PER_MM * point
    painter.save()
    painter.translate(MARGIN_MM * mm, MARGIN_MM * mm)
    paint(painter, (PAPER_MM[0] - 2 * MARGIN_MM) * mm / WIDTH)
    painter.restore()


def _page_painter(pairs: AnglePairs, compared: Comparison, limit_deg: float) -> PaintPlots:
    """Return a function that paints an angle's values and both plots, scaled by units per design pixel."""
    f = pairs.figures_deg
    values = [
        f"RMSE {format_tenths(f.rmse)}",
        f"r {format_coefficient(f.correlation)}",
        f"ICC(2,1) {format_coefficient(f.icc)}",
        f"ICC(3,1) {format_coefficient(f.icc_3_1)}",
    ]
    if math.isfinite(f.cmc):
        values.append(f"CMC {format_coefficient(f.cmc)}")
    words = (
        tr("{count} pairs, {kind}")
        if compared.frame_count == 0
        else tr("{count} pairs of one session, compared with {kind}")
    )
    values.append(words.format(count=f.count, kind=translate_phrase(compared.kind)))
    is_time_series = compared.shift is not None
    curves = chart_part(partial(CurveChart, pairs=pairs, is_time_series=is_time_series), 150, HEIGHT, STYLE)
    differences = partial(DifferenceChart, pairs=pairs, is_time_series=is_time_series, limit_deg=limit_deg)
    plots = line((curves, 10), (chart_part(differences, 150, HEIGHT, STYLE), 11), gap=24)
    remarks = [paragraph(one, 13, token="warn") for one in remark_words(compared, pairs.name)]
    body = column(
        paragraph(angle_name(pairs.name), 20, SEMIBOLD), paragraph("   ".join(values), 13), *remarks, (plots, 1), gap=6
    )
    body.setContentsMargins(*[UNIT * EDGE] * 4)
    host, _ = fit_parts(body, UNIT * WIDTH, UNIT * HEIGHT)
    host.resize(UNIT * WIDTH, UNIT * HEIGHT)

    def paint(painter: QPainter, pixel: float) -> None:
        painter.save()
        painter.scale(pixel / UNIT, pixel / UNIT)
        render_parts(host, painter)
        painter.restore()

    return paint
