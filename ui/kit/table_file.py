"""Tables saved for spreadsheets in the format of the user's region."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from itertools import count
from pathlib import Path

from PySide6.QtCore import QLocale

from carpus.core.formats.output_files import TableDialect, open_new_file, require_folder, write_rows
from carpus.ui.kit import language

OFFERED_REGIONS = ("en_GB", "en_US", "de_DE", "de_AT", "de_CH", "it_IT", "it_CH")
"""Regions offered in addition to the user's own."""


def regional_table_form(region: str) -> TableDialect:
    """Return the table format that spreadsheets of a region (``de_DE``) read.

    Raises ValueError for an unknown region.
    """
    locale = QLocale(region.replace("-", "_"))
    asked = region.replace("-", "_").split("_")
    if locale.language() == QLocale.Language.C or not set(asked) <= set(locale.name().split("_")):
        raise ValueError(f"no region is called “{region}”; names are as de_DE, it_IT, en_GB")
    decimal = "," if locale.decimalPoint() == "," else "."
    # Spreadsheets of Switzerland part cells by a semicolon, with a decimal point.
    is_swiss = locale.territory() in (QLocale.Country.Switzerland, QLocale.Country.Liechtenstein)
    return TableDialect(";" if decimal == "," or is_swiss else ",", decimal, has_bom=True)


def user_region() -> str:
    """Return the user's region: of the computer's formats, else of the language."""
    system = QLocale.system()
    return (language.locale() if system.language() == QLocale.Language.C else system).name()


def save_private(path: Path, content: bytes) -> None:
    """Write a file that only the user can read, replacing an existing one.

    Raises :class:`DiskFull` or :class:`OutputNotWritable`; then the old file stays.
    """
    require_folder(path)
    with open_new_file(path, overwrite=True) as file:
        file.write(content)


def save_table(path: Path, head: Sequence[str], rows: Iterable[Iterable[object]]) -> None:
    """Write a table in the format of the user's region, with no cell that a spreadsheet would evaluate."""
    text = io.StringIO()
    write_rows(text, head, (map(str, row) for row in rows), regional_table_form(user_region()))
    save_private(path, text.getvalue().encode("utf-8-sig"))


def companion_path(path: Path, ending: str, *, can_replace: bool) -> Path:
    """Return the path of a second table next to ``path``, whose name the user chose.

    An existing file is replaced only if ``can_replace``.
    """
    names = (f"{path.stem}{ending}{'' if number == 1 else f'-{number}'}{path.suffix}" for number in count(1))
    places = (path.with_name(name) for name in names)
    return next(place for place in places if can_replace or not place.exists())
