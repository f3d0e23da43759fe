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

from carpus.app.command_line import print_fault, print_message
from carpus.app.settings import Settings, load_valid_settings, sessions_folder
from carpus.core.model.errors import CarpusFault, DataFolderMissing, FolderMissing, StudyUnsuited
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    import sqlite3

    from carpus.core.formats.export import ExportResult
    from carpus.core.records.library import Library
    from carpus.core.records.log import AuditAction, SubjectKind
    from carpus.core.records.session_records import OutputKind
    from carpus.core.records.store import Store
    from carpus.core.results.repetition_rows import RepetitionChoices
    from carpus.core.results.report_form import ReportForm
    from carpus.core.results.session_results import SessionResults


STORE_FILE = "records.sqlite3"
"""As in :mod:`core.records`, which is loaded only for a file that lies in a data folder."""


def find_data_folder(path: Path) -> Path | None:
    """The data folder in which a file lies, or this computer's for one on the clinic's share; None for any other."""
    parents = Path(os.path.realpath(path)).parents
    settings, _ = load_valid_settings()
    share = sessions_folder(settings)
    if share is not None and share.resolve() in parents and has_store(settings.data_folder):
        return settings.data_folder
    return next((folder for folder in parents if has_store(folder)), None)


def has_store(folder: Path) -> bool:
    """Whether a data folder has a list of patients: in it or, of this computer's own, on the clinic's server."""
    return (folder / STORE_FILE).is_file() or bool(_find_server_url(folder))


def require_store(folder: Path) -> None:
    """Raises :class:`FolderMissing`, :class:`DataFolderMissing` for a folder without a list of patients: a look makes
    none."""
    if not has_store(folder):
        raise DataFolderMissing(folder) if folder.is_dir() else FolderMissing(folder)


def open_store(
    folder: Path, *, read_only: bool = False, on_fault: Callable[[CarpusFault], None] = print_fault
) -> Store:
    """That of a data folder, on the clinic's server where it is this computer's own; also of one that cannot be
    written, for who ``read_only``. Raises what :func:`require_store` does, and the faults of a store."""
    from carpus.core.records.store import Store, open_to_read

    require_store(folder)
    return (open_to_read if read_only else Store)(
        folder, _find_shared_folder(folder), _find_server_url(folder), on_fault
    )


def make_server_copier(folder: Path) -> Callable[[], sqlite3.Connection] | None:
    """Makes a copy of the store of a data folder that lies on the clinic's server; None for any other."""

    def copy_store() -> sqlite3.Connection:
        with open_store(folder) as store:
            return store.copy_to_memory()

    return copy_store if _find_server_url(folder) else None


def _find_server_url(folder: Path) -> str:
    settings, _ = load_valid_settings()
    return settings.records.url if _is_default_folder(folder, settings) else ""


def _find_shared_folder(folder: Path) -> Path | None:
    settings, _ = load_valid_settings()
    return sessions_folder(settings) if _is_default_folder(folder, settings) else None


def _is_default_folder(folder: Path, settings: Settings) -> bool:
    return os.path.realpath(folder) == os.path.realpath(settings.data_folder)


def is_practice_file(path: Path) -> bool:
    """Whether a file of a data folder is the practice patient's."""
    return Path(os.path.realpath(path)).parent.name == PRACTICE_PATIENT


def read_choices(path: Path) -> RepetitionChoices:
    """What a person left out or moved of a session; nothing outside every data folder."""
    from carpus.core.results.repetition_rows import RepetitionChoices

    folder = find_data_folder(path)
    if folder is None:
        return RepetitionChoices()
    from carpus.core.records.session_records import read_choices

    with open_store(folder, read_only=True) as store:
        return read_choices(store, read_outline(path).header.session_id)[0]


def read_comment(path: Path) -> str:
    """What the therapist wrote of a session last; empty outside every data folder."""
    folder = find_data_folder(path)
    if folder is None:
        return ""
    from carpus.core.records.session_records import current_comment, read_comments

    with open_store(folder, read_only=True) as store:
        return current_comment(read_comments(store, read_outline(path).header.session_id))


def read_report_form(folder: Path) -> ReportForm:
    """The form of reports of a data folder."""
    from carpus.core.records.clinic_records import read_form
    from carpus.core.results.report_form import ReportForm

    if not has_store(folder):
        return ReportForm()
    with open_store(folder, read_only=True) as store:
        return read_form(store)


def find_session_files(places: Iterable[Path]) -> Iterator[Path]:
    """Session files, and those of folders, in order. Raises :class:`FolderMissing`."""
    for place in places:
        if not place.exists():
            raise FolderMissing(place)
        yield from sorted(place.rglob("*.h5")) if place.is_dir() else [place]


def read_figures(
    places: Sequence[Path],
    on_fault: Callable[[CarpusFault], object],
    raters_by_file: Mapping[str, str] = MappingProxyType({}),
) -> tuple[list[SessionResults], dict[str, str]]:
    """Figures of all sessions, and their raters by session id; ``on_fault`` hears of those that cannot be read.

    Raises :class:`FolderMissing`, and :class:`StudyUnsuited` where none can be read.
    """
    from carpus.core.results.session_results import compute_session_results
    from carpus.core.session.reader import read_session

    figures, raters, met = [], {}, set()
    for path in find_session_files(places):
        try:
            figures.append(compute_session_results(read_session(path), read_choices(path)))
        except CarpusFault as fault:
            on_fault(fault)
            continue
        for name in (path.name, path.stem):
            if name in raters_by_file:
                raters[figures[-1].session_id] = raters_by_file[name]
                met.add(name)
    if not figures:
        raise StudyUnsuited(places[0], "no session can be read")
    for name in sorted(set(raters_by_file) - met):
        print_message(f"no session is called {name}, which the list of raters names.")
    return figures, raters


def open_library(folder: Path, *, read_only: bool = False) -> Library:
    """Of a data folder, with the clinic's server and share where it is this computer's own; also of one that cannot be
    written, for who ``read_only``."""
    from carpus.core.records.library import Library

    url, share = _find_server_url(folder), _find_shared_folder(folder)
    library = Library(folder, source="command", url=url, sessions_folder=share, read_only=read_only)
    library.get_initials = user_initials
    library.on_fault = print_fault
    return library


def user_initials() -> str:
    """Of the person at this computer, as the window knows them."""
    return load_valid_settings()[0].report.therapist


def log_session_action(action: AuditAction, path: Path, session_id: str) -> None:
    """Take down what a command does with a session; where that cannot be written a warning is said."""
    folder = find_data_folder(path)
    if folder is not None and not is_practice_file(path):
        log_folder_action(folder, action, "session", session_id)


def log_folder_action(
    folder: Path, action: AuditAction, kind: SubjectKind = "program", identity: str = "", **facts: int | str
) -> None:
    """Take down what a command does with a data folder; where that cannot be written a warning is said."""
    from carpus.core.records.log import AuditLogWriter

    try:
        with open_store(folder) as store:
            AuditLogWriter(store, "command", user_initials).write_entry(action, kind, identity, **facts)
    except CarpusFault as fault:
        print_fault(fault)


def log_created_files(sessions: Sequence[tuple[Path, str]], files: Sequence[Path], kind: OutputKind) -> None:
    """Take down what was made from sessions, each with its identity, so that it is named when one of them is erased."""
    from carpus.core.records.session_records import record_output_files

    folders = {path: find_data_folder(path) for path, _ in sessions}
    for folder in {one for one in folders.values() if one is not None}:
        own = [(path, session_id) for path, session_id in sessions if folders[path] == folder]
        try:
            with open_store(folder) as store:
                record_output_files(store, files, kind, [session_id for _, session_id in own])
        except CarpusFault as fault:
            print_fault(fault)
            continue
        for path, session_id in own:
            log_session_action("reported" if kind == "report" else "exported", path, session_id)


def log_export(done: ExportResult, *, deidentified: bool) -> None:
    """Take down what was exported of sessions of a data folder, so that it is named when one of these is erased; what
    leads back to nobody is only noted."""
    shared = [path for path in done.files if not any(path in of for of in done.files_by_session.values())]
    for path, own in done.files_by_session.items():
        if find_data_folder(path) is None:
            continue
        session_id = read_outline(path).header.session_id
        if deidentified:
            log_session_action("exported", path, session_id)
        else:
            log_created_files([(path, session_id)], [*own, *shared], "export")
