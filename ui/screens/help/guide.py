"""Pages of the guide in resources/guide: their HTML in the theme's colours, and cards to print of two of them."""

from __future__ import annotations

import html
import re
from functools import lru_cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QSizeF, QUrl
from PySide6.QtGui import QPageLayout, QPageSize, QPdfWriter, QTextDocument

from carpus.core.formats.output_files import open_new_file
from carpus.core.model.phrase import LANGUAGES
from carpus.ui.kit import language
from carpus.ui.kit.fonts import TEXT_FAMILY
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr

DEFAULT_LANGUAGE = "en"
"""Language of the guide where it is not translated."""
PAGES = (
    "session", "exercises", "discs", "camera", "calibration", "measuring", "patient", "figures", "limits", "correct",
    "sessions", "data", "trouble", "cameracheck", "checking",
)  # fmt: skip
"""Pages in the order of the guide."""
KEYS_PAGE = "keys"
_MARK = re.compile(r"\*\*(.+?)\*\*")
_CODE = re.compile(r"`(.+?)`")
_LINK = re.compile(r"\[(.+?)\]\((\w+)\.md\)")
_PICTURE = re.compile(r"!\[(.*)\]\((.+)\)")
_NUMBERED = re.compile(r"\d+\. ")


def load_page(page: str) -> str:
    """Load a page in the current language.

    It is a subset of Markdown: headings, paragraphs, lists, tables, bold, code, links, pictures.
    """
    return _read_page(language.current_language(), page)


@lru_cache(maxsize=len(LANGUAGES) * len(PAGES))
def _read_page(code: str, page: str) -> str:
    return (_folder(code) / f"{page}.md").read_text("utf-8")


def picture_path(name: str) -> str:
    """Return the path of a picture of the guide in the current language."""
    return str(_folder(language.current_language()) / name)


def _folder(code: str) -> Traversable:
    guides = files("carpus.resources") / "guide"
    return guides / (code if (guides / code).is_dir() else DEFAULT_LANGUAGE)


def page_title(page: str) -> str:
    """Return the first line of a page."""
    return load_page(page).splitlines()[0].removeprefix("# ")


def page_html(page: str, theme: Theme, width_px: int) -> str:
    """Return a page as HTML in the theme's style, with pictures at most ``width_px`` wide."""
    return _apply_style(_markdown_to_html(load_page(page), width_px), theme)


def keys_html(heading: str, rows: list[tuple[str, str]], theme: Theme) -> str:
    """Return the table of shortcuts as HTML."""
    lines = "".join(
        f'<tr><td class="key">{html.escape(key)}</td><td>{html.escape(words).replace(chr(10), "<br>")}</td></tr>'
        for key, words in rows
    )
    return _apply_style(f"<h1>{html.escape(heading)}</h1><table cellpadding='6'>{lines}</table>", theme)


def _markdown_to_html(text: str, width_px: int) -> str:
    out: list[str] = []
    listed = ""
    for line in text.splitlines():
        kind = "ol" if _NUMBERED.match(line) else {"-": "ul", "|": "table"}.get(line[:1], "")
        if kind != listed:
            out += [f"</{listed}>"] if listed else []
            out += [f"<{kind}>"] if kind else []
            listed = kind
        if kind == "table":
            cells = [_format_inline(cell.strip()) for cell in line.strip("|").split("|")]
            if set(line) != {"|", "-"}:  # the rule below the head
                tag = "td" if out[-1] != "<table>" else "th"
                out.append(f"<tr>{''.join(f'<{tag}>{cell}</{tag}>' for cell in cells)}</tr>")
        elif kind:
            out.append(f"<li>{_format_inline(line.split(' ', 1)[1])}</li>")
        elif line.startswith("## "):
            out.append(f"<h2>{_format_inline(line[3:])}</h2>")
        elif line.startswith("# "):
            out.append(f"<h1>{_format_inline(line[2:])}</h1>")
        elif found := _PICTURE.fullmatch(line):
            out.append(f'<p><img src="{html.escape(found[2])}" width="{width_px}"></p>')
            out.append(f'<p class="caption">{_format_inline(found[1])}</p>')
        elif line.strip():
            out.append(f"<p>{_format_inline(line)}</p>")
    out += [f"</{listed}>"] if listed else []
    return "".join(out)


def _format_inline(text: str) -> str:
    words = _CODE.sub(r"<code>\1</code>", html.escape(text, quote=False))
    return _LINK.sub(r'<a href="\2">\1</a>', _MARK.sub(r"<b>\1</b>", words))


def _apply_style(body: str, theme: Theme) -> str:
    tokens, px = theme.tokens, theme.px
    style = (
        f"body {{ font-family: '{TEXT_FAMILY}'; font-size: {px(16)}px; color: {tokens.text}; }}"
        f"h1 {{ font-size: {px(28)}px; font-weight: 600; margin-bottom: {px(12)}px; }}"
        f"h2 {{ font-size: {px(20)}px; font-weight: 600; margin-top: {px(20)}px; margin-bottom: {px(6)}px; }}"
        f"p, li {{ margin-top: {px(4)}px; margin-bottom: {px(8)}px; }}"
        f"th, td {{ text-align: left; padding: {px(3)}px {px(24)}px {px(3)}px 0; }}"
        f".caption, .key {{ color: {tokens.text2}; font-size: {px(14)}px; }}"
        f"a {{ color: {tokens.accent}; font-weight: 600; text-decoration: none; }}"
    )
    return f"<html><head><style>{style}</style></head><body>{body}</body></html>"


CARDS_FILE_NAME = "carpus-cards.pdf"
CARD_PAGES = ("discs", "camera")  # markers, and camera, arm and light
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
    document.setBaseUrl(QUrl.fromLocalFile(picture_path("") + "/"))
    bodies = [page_html(page, Theme("light"), PICTURE_PX) for page in CARD_PAGES]
    document.setHtml(bodies[0] + "<p style='page-break-after: always'></p>" + bodies[1])
    for scale in SCALES:
        document.setPageSize(QSizeF(writer.width(), writer.height()) / scale)
        if document.pageCount() == len(CARD_PAGES):
            break
    document.print_(writer)
    buffer.close()
    with open_new_file(path, overwrite=True) as file:
        file.write(store.data())
