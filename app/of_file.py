"""What people wrote about a session, for a command or a script that has its file."""

from __future__ import annotations

from pathlib import Path

from carpus.app.settings import load_sound_settings, sessions_folder
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_outline

STORE_FILE = "records.sqlite3"
"""As in :mod:`core.records`, which is loaded only for a file that lies in a data folder."""


def data_folder_of(path: Path) -> Path | None:
    """The data folder in which a file lies, or this computer's for one on the clinic's share; None for any other."""
    parents = path.resolve().parents
    own = next((folder for folder in parents if (folder / STORE_FILE).is_file()), None)
    if own is not None:
        return own
    settings, _ = load_sound_settings()
    share = sessions_folder(settings)
    on_share = share is not None and share.resolve() in parents
    return settings.data_folder if on_share and (settings.data_folder / STORE_FILE).is_file() else None


def is_of_practice(path: Path) -> bool:
    """Whether a file of a data folder is the practice patient's."""
    return path.resolve().parent.name == PRACTICE_PATIENT


def read_choices(path: Path) -> RepetitionChoices:
    """What a person left out or moved of a session; nothing outside every data folder."""
    folder = data_folder_of(path)
    if folder is None:
        return RepetitionChoices()
    from carpus.core.records.of_sessions import choices
    from carpus.core.records.store import Store

    with Store(folder) as store:
        return choices(store, read_outline(path).header.session_id)[0]


def read_comment(path: Path) -> str:
    """What the therapist wrote of a session last; empty outside every data folder."""
    folder = data_folder_of(path)
    if folder is None:
        return ""
    from carpus.core.records.of_sessions import comments, latest
    from carpus.core.records.store import Store

    with Store(folder) as store:
        return latest(comments(store, read_outline(path).header.session_id))
