"""What commands do with sessions that lie in a data folder stands in its log, as what the window does.

Files that lie elsewhere are a person's own; nothing is written down of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.commands.progress import tell
from carpus.app.of_file import data_folder_of, is_of_practice
from carpus.app.settings import load_sound_settings
from carpus.core.errors import CarpusFault
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    from carpus.core.formats.export import Exported
    from carpus.core.records.log import Deed, Kind
    from carpus.core.records.of_sessions import MadeKind


def initials() -> str:
    """Of the person at this computer, as the window knows them."""
    return load_sound_settings()[0].report.therapist


def note(did: Deed, path: Path, session_id: str) -> None:
    """Take down what a command does with a session; where that cannot be written a warning is said."""
    folder = data_folder_of(path)
    if folder is not None and not is_of_practice(path):
        note_in(folder, did, "session", session_id)


def note_in(folder: Path, did: Deed, kind: Kind = "program", identity: str = "", **facts: int | str) -> None:
    """Take down what a command does with a data folder; where that cannot be written a warning is said."""
    from carpus.core.records.log import Log
    from carpus.core.records.store import Store

    try:
        with Store(folder) as store:
            Log(store, "command", initials).note(did, kind, identity, **facts)
    except CarpusFault as fault:
        tell(fault)


def made(sessions: Sequence[tuple[Path, str]], files: Sequence[Path], kind: MadeKind) -> None:
    """Take down what was made from sessions, each with its identity, so that it is named when one of them is erased."""
    from carpus.core.records.of_sessions import remember_made
    from carpus.core.records.store import Store

    folders = {path: data_folder_of(path) for path, _ in sessions}
    for folder in {one for one in folders.values() if one is not None}:
        own = [(path, session_id) for path, session_id in sessions if folders[path] == folder]
        try:
            with Store(folder) as store:
                remember_made(store, files, kind, [session_id for _, session_id in own])
        except CarpusFault as fault:
            tell(fault)
        for path, session_id in own:
            note("reported" if kind == "report" else "exported", path, session_id)


def note_exported(done: Exported, *, deidentified: bool) -> None:
    """Take down what was exported of sessions of a data folder, so that it is named when one of these is erased; what
    leads back to nobody is only noted."""
    shared = [path for path in done.files if not any(path in of for of in done.parts.values())]
    for path, own in done.parts.items():
        if data_folder_of(path) is None:
            continue
        session_id = read_outline(path).header.session_id
        if deidentified:
            note("exported", path, session_id)
        else:
            made([(path, session_id)], [*own, *shared], "export")
