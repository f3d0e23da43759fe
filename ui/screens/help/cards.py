"""Pages of the guide to print and hang beside the camera: markers, and camera, arm and light."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QSizeF, QUrl
from PySide6.QtGui import QPageLayout, QPageSize, QPdfWriter, QTextDocument

from carpus.core.formats.output_files import open_new_file
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.screens.help import guide

FILE_NAME = "carpus-cards.pdf"
PAGES = ("discs", "camera")
MARGIN_MM, DPI, PICTURE_PX = 15.0, 96, 540
# Of the size on the screen: the first at which each page of the guide is one of paper.
SCALES = (0.7, 0.65, 0.6, 0.55, 0.5)


def write_cards(path: Path) -> None:
    """Write both pages as a PDF of A4 pages.

    Raises :class:`DiskFull` or :class:`OutputNotWritable`; then an old file stays.
    """
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(DPI)
    writer.setCreator("Carpus")
    writer.setTitle(tr("Carpus: markers and set-up"))
    margins = QMarginsF(MARGIN_MM, MARGIN_MM, MARGIN_MM, MARGIN_MM)
    a4, upright = QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait
    writer.setPageLayout(QPageLayout(a4, upright, margins, QPageLayout.Unit.Millimeter))
    document = QTextDocument()
    document.setBaseUrl(QUrl.fromLocalFile(guide.picture_path("") + "/"))
    bodies = [guide.page_html(page, Theme("light"), PICTURE_PX) for page in PAGES]
    document.setHtml(bodies[0] + "<p style='page-break-after: always'></p>" + bodies[1])
    for scale in SCALES:
        document.setPageSize(QSizeF(writer.width(), writer.height()) / scale)
        if document.pageCount() == len(PAGES):
            break
    document.print_(writer)
    buffer.close()
    with open_new_file(path, overwrite=True) as file:
        file.write(store.data())
