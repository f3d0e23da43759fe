"""The card that says which files were written, with the way to their folder."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

from carpus.core.words import Words
from carpus.ui.messages.messages import Messages
from carpus.ui.messages.stop_card import Answer
from carpus.ui.translate import tr

MOST_NAMES = 3
"""On the card; a data set has dozens, and each name may need two lines."""
BREAK = "\u200b"
"""Where a long name may go on in the next line; it takes no room."""


def shown(names: Sequence[str]) -> str:
    """Names for a card.

    >>> shown(["a", "b"]), shown(list("abcdefgh"))
    ('a, b', 'a, b, c, …')
    """
    listed = [name.replace("_", f"_{BREAK}").replace(".", f"{BREAK}.") for name in names[:MOST_NAMES]]
    return ", ".join([*listed, *(["…"] if len(names) > MOST_NAMES else [])])


def tell_written(tell: Messages, folder: str, names: Sequence[str]) -> None:
    """Say what went where, and offer to open the folder."""
    count = len(names)
    what = tr("1 file was written.") if count == 1 else tr("{count} files were written.")
    tell.ask(
        Words(
            what.format(count=count),
            tr("Folder: {folder}").format(folder=folder),
            tr("Files: {names}").format(names=shown(names)),
        ),
        (
            Answer(tr("Open the folder"), lambda: open_folder(folder), "O"),
            Answer(tr("Go on"), lambda: None),
        ),
        icon="download",
    )


def open_folder(folder: str) -> None:
    """Show a folder in the system's own way."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(folder))
