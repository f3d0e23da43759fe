"""What people wrote about a session, for a command or a script that has its file; and what it does with sessions that
lie in a data folder, which stands in the log of that folder, as what the window does.

Files that lie elsewhere are a person's own; nothing is written down of them.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from carpus.app.command_line import say, tell
from carpus.app.settings import Settings, load_sound_settings, sessions_folder
from carpus.core.errors import CarpusFault, FolderMissing, NoDataFolder, StudyUnsuited
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    import sqlite3

    from carpus.core.formats.formats import Exported
    from carpus.core.records.library import Library
    from carpus.core.records.log import Deed, Kind
    from carpus.core.records.of_sessions import MadeKind
    from carpus.core.records.store import Store
    from carpus.core.results.figures import SessionFigures
    from carpus.core.results.repetition_rows import RepetitionChoices
    from carpus.core.results.report_form import ReportForm


STORE_FILE = "records.sqlite3"
"""As in :mod:`core.records`, which is loaded only for a file that lies in a data folder."""


def data_folder_of(path: Path) -> Path | None:
    """The data folder in which a file lies, or this computer's for one on the clinic's share; None for any other."""
    parents = Path(os.path.realpath(path)).parents
    settings, _ = load_sound_settings()
    share = sessions_folder(settings)
    if share is not None and share.resolve() in parents and has_store(settings.data_folder):
        return settings.data_folder
    return next((folder for folder in parents if has_store(folder)), None)


def has_store(folder: Path) -> bool:
    """Whether a data folder has a list of patients: in it or, of this computer's own, on the clinic's server."""
    return (folder / STORE_FILE).is_file() or bool(_server_of(folder))


def look_for_store(folder: Path) -> None:
    """Raises :class:`FolderMissing`, :class:`NoDataFolder` for a folder without a list of patients: a look makes
    none."""
    if not has_store(folder):
        raise NoDataFolder(folder) if folder.is_dir() else FolderMissing(folder)


def open_store(folder: Path, *, only_reads: bool = False, told: Callable[[CarpusFault], None] = tell) -> Store:
    """That of a data folder, on the clinic's server where it is this computer's own; also of one that cannot be
    written, for who ``only_reads``. Raises what :func:`look_for_store` does, and the faults of a store."""
    from carpus.core.records.store import Store, reading

    look_for_store(folder)
    return (reading if only_reads else Store)(folder, _share_of(folder), _server_of(folder), told)


def copy_of_server(folder: Path) -> Callable[[], sqlite3.Connection] | None:
    """Makes a copy of the store of a data folder that lies on the clinic's server; None for any other."""

    def copied() -> sqlite3.Connection:
        with open_store(folder) as store:
            return store.copied()

    return copied if _server_of(folder) else None


def _server_of(folder: Path) -> str:
    settings, _ = load_sound_settings()
    return settings.records.url if _is_own(folder, settings) else ""


def _share_of(folder: Path) -> Path | None:
    settings, _ = load_sound_settings()
    return sessions_folder(settings) if _is_own(folder, settings) else None


def _is_own(folder: Path, settings: Settings) -> bool:
    return os.path.realpath(folder) == os.path.realpath(settings.data_folder)


def is_of_practice(path: Path) -> bool:
    """Whether a file of a data folder is the practice patient's."""
    return Path(os.path.realpath(path)).parent.name == PRACTICE_PATIENT


def read_choices(path: Path) -> RepetitionChoices:
    """What a person left out or moved of a session; nothing outside every data folder."""
    from carpus.core.results.repetition_rows import RepetitionChoices

    folder = data_folder_of(path)
    if folder is None:
        return RepetitionChoices()
    from carpus.core.records.of_sessions import choices

    with open_store(folder, only_reads=True) as store:
        return choices(store, read_outline(path).header.session_id)[0]


def read_comment(path: Path) -> str:
    """What the therapist wrote of a session last; empty outside every data folder."""
    folder = data_folder_of(path)
    if folder is None:
        return ""
    from carpus.core.records.of_sessions import comments, latest

    with open_store(folder, only_reads=True) as store:
        return latest(comments(store, read_outline(path).header.session_id))


def form_of(folder: Path) -> ReportForm:
    """The form of reports of a data folder."""
    from carpus.core.records.of_clinic import read_form
    from carpus.core.results.report_form import ReportForm

    if not has_store(folder):
        return ReportForm()
    with open_store(folder, only_reads=True) as store:
        return read_form(store)


def sessions_in(places: Iterable[Path]) -> Iterator[Path]:
    """Session files, and those of folders, in order. Raises :class:`FolderMissing`."""
    for place in places:
        if not place.exists():
            raise FolderMissing(place)
        yield from sorted(place.rglob("*.h5")) if place.is_dir() else [place]


def read_figures(
    places: Sequence[Path], told: Callable[[CarpusFault], object], named: Mapping[str, str] = MappingProxyType({})
) -> tuple[list[SessionFigures], dict[str, str]]:
    """Figures of all sessions, and their raters by session id; ``told`` hears of those that cannot be read.

    Raises :class:`FolderMissing`, and :class:`StudyUnsuited` where none can be read.
    """
    from carpus.core.results.figures import session_figures
    from carpus.core.session.reader import read_session

    figures, raters, met = [], {}, set()
    for path in sessions_in(places):
        try:
            figures.append(session_figures(read_session(path), read_choices(path)))
        except CarpusFault as fault:
            told(fault)
            continue
        for name in (path.name, path.stem):
            if name in named:
                raters[figures[-1].session_id] = named[name]
                met.add(name)
    if not figures:
        raise StudyUnsuited(places[0], "no session can be read")
    for name in sorted(set(named) - met):
        say(f"no session is called {name}, which the list of raters names.")
    return figures, raters


def library_of(folder: Path, *, only_reads: bool = False) -> Library:
    """Of a data folder, with the clinic's server and share where it is this computer's own; also of one that cannot be
    written, for who ``only_reads``."""
    from carpus.core.records.library import Library

    url, share = _server_of(folder), _share_of(folder)
    library = Library(folder, by="command", url=url, sessions=share, only_reads=only_reads)
    library.who = initials
    library.log_fault = tell
    return library


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

    try:
        with open_store(folder) as store:
            Log(store, "command", initials).note(did, kind, identity, **facts)
    except CarpusFault as fault:
        tell(fault)


def made(sessions: Sequence[tuple[Path, str]], files: Sequence[Path], kind: MadeKind) -> None:
    """Take down what was made from sessions, each with its identity, so that it is named when one of them is erased."""
    from carpus.core.records.of_sessions import remember_made

    folders = {path: data_folder_of(path) for path, _ in sessions}
    for folder in {one for one in folders.values() if one is not None}:
        own = [(path, session_id) for path, session_id in sessions if folders[path] == folder]
        try:
            with open_store(folder) as store:
                remember_made(store, files, kind, [session_id for _, session_id in own])
        except CarpusFault as fault:
            tell(fault)
            continue
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
