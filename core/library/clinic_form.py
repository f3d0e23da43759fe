"""Where the clinic's form of reports is kept: in the data folder, of no patient, the logo as a copy of its own."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path

from carpus.core.durable import replace_file
from carpus.core.errors import SettingsInvalid
from carpus.core.output.report_form import (
    MOST_ADDRESS,
    MOST_ADDRESS_LINES,
    MOST_NAME,
    MOST_SENTENCE,
    MOST_SENTENCES,
    PAPERS,
    SECTIONS,
    Letterhead,
    Paper,
    ReportForm,
)
from carpus.core.phrase import phrase

FORM_FILE, LOGO_FILE = "report_form.json", "report_logo.png"


def read_form(folder: Path, usual: Paper = "a4", *, with_logo: bool = True) -> ReportForm:
    """The form of a data folder; where there is none, no letterhead and the ``usual`` paper.

    Raises :class:`SettingsInvalid` for a file that cannot be read.
    """
    path = folder / FORM_FILE
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        paper = stored.get("paper", usual)
        logo = (folder / LOGO_FILE).read_bytes() if with_logo and stored.get("logo") is True else b""
        address = tuple(str(line)[:MOST_ADDRESS] for line in stored.get("address", []))[:MOST_ADDRESS_LINES]
        return ReportForm(
            Letterhead(str(stored.get("name", ""))[:MOST_NAME], address, logo),
            paper if paper in PAPERS else usual,
            frozenset(name for name in stored.get("left_out", []) if name in SECTIONS),
            tuple(str(one)[:MOST_SENTENCE] for one in stored.get("sentences", []))[:MOST_SENTENCES],
        )
    except FileNotFoundError as missing:
        if missing.filename is not None and Path(missing.filename).name == LOGO_FILE:
            raise SettingsInvalid(
                folder / LOGO_FILE, phrase("the logo of the reports is gone; choose it again")
            ) from None
        return ReportForm(paper=usual)
    except (OSError, ValueError, TypeError, AttributeError, RecursionError) as cause:
        raise SettingsInvalid(path, phrase("the form of the reports cannot be read")) from cause


def keep_form(folder: Path, form: ReportForm) -> None:
    """Store it; a file that could not be read is kept beside.

    Raises :class:`OutputNotWritable` or :class:`DiskFull`.
    """
    head = form.letterhead
    content = {
        "name": head.name,
        "address": list(head.address),
        "logo": bool(head.logo_png),
        "paper": form.paper,
        "left_out": sorted(form.left_out),
        "sentences": list(form.sentences),
    }
    if head.logo_png:
        replace_file(folder / LOGO_FILE, lambda place: place.write_bytes(head.logo_png))
    path = folder / FORM_FILE
    try:
        read_form(folder, with_logo=False)
    except SettingsInvalid:
        with suppress(OSError):
            path.replace(path.with_suffix(".unusable.json"))
    text = json.dumps(content, indent=1, ensure_ascii=False)
    replace_file(path, lambda place: place.write_text(text, encoding="utf-8"))
    if not head.logo_png:
        (folder / LOGO_FILE).unlink(missing_ok=True)
