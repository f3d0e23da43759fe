"""The program's own log, for support; no line contains a patient's name."""

from __future__ import annotations

import logging
import re
import sys
from collections.abc import Callable, Sequence
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

import platformdirs

from carpus.core.model.errors import CarpusFault
from carpus.core.platform.durable import make_private_folder

SESSION_PATH = re.compile(r"\S*(?:sessions[\\/]|_\d{4}-\d\d-\d\d_\d{6}_)\S*")
"""A path or file name that contains a pseudonym."""
LOG_FILE, LOG_BYTES = "carpus.log", 1_000_000


class RedactingFormatter(logging.Formatter):
    """Formatter that cuts names and the paths of patients out of each line."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(name)s %(levelname)s %(message)s")
        self.find_names: Callable[[], Sequence[str]] = lambda: ()
        """Returns further names to cut out; called for each line, of which there are few."""

    def format(self, record: logging.LogRecord) -> str:
        text = SESSION_PATH.sub("…", super().format(record))
        for name in self.find_names():
            text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", "…", text, flags=re.IGNORECASE)
        return text


LOG_FORMATTER = RedactingFormatter()


def start_log() -> None:
    """Log into the user's log folder; without a log if that cannot be written."""
    folder = Path(platformdirs.user_log_dir("carpus", appauthor=False))
    handler: logging.Handler
    try:
        make_private_folder(folder)
        for old in folder.glob(f"{LOG_FILE}*"):
            old.chmod(0o600)
        handler = RotatingFileHandler(folder / LOG_FILE, maxBytes=LOG_BYTES, backupCount=2, encoding="utf-8")
    except (OSError, CarpusFault):
        handler = logging.NullHandler()
    logging.raiseExceptions = False  # a full disk costs lines of the log, and nothing else
    handler.setFormatter(LOG_FORMATTER)
    logging.basicConfig(level=logging.INFO, handlers=[handler])
    logging.getLogger("alembic").setLevel(logging.WARNING)  # how the store is set up says nothing to a person


def show_uncaught_errors(show_error: Callable[[Exception], None]) -> None:
    """Turn uncaught exceptions into a message and a line in the log."""

    def hook(kind: type[BaseException], value: BaseException, trace: TracebackType | None) -> None:
        logging.getLogger("carpus").error("uncaught", exc_info=(kind, value, trace))
        if isinstance(value, Exception):
            show_error(value)

    sys.excepthook = hook
