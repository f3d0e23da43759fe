"""What commands and scripts read from, and log in, the data folder of a session file.

Files outside a data folder are a person's own: nothing is logged.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import print_fault
from carpus.app.settings import load_valid_settings, sessions_folder
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    import sqlite3

    from carpus.core.formats.export import ExportResult
    from carpus.core.measures.change_limits import ErrorLimits
    from carpus.core.records.data_folder import DataFolder
    from carpus.core.records.log import AuditAction, SubjectKind
    from carpus.core.records.session_records import OutputKind
    from carpus.core.records.store import Store
    from carpus.core.results.repetition_rows import RepetitionChoices
    from carpus.core.results.report_form import ReportForm
    from carpus.core.results.session_results import SessionResults


TRUTH_FILE = "truth.h5"
"""Of a simulated recording: named, a session as any other; in a folder, none that was measured."""
STORE_FILE = "records.sqlite3"
"""As in :mod:`core.records`, which is imported only for files of a data folder."""


def find_data_folder(path: Path) -> Path | None:
    """Return the data folder of a file (this computer's for a file on its share), or None."""
    parents = Path(os.path.realpath(path)).parents
    settings, _ = load_valid_settings()
    share, own = sessions_folder(settings), settings.data_folder
    if share is not None and share.resolve() in parents and has_store(own):
        return own
    on_server = Path(os.path.realpath(own)) if settings.records.url else None
    return next((folder for folder in parents if folder == on_server or (folder / STORE_FILE).is_file()), None)


def has_store(folder: Path) -> bool:
    """Tell whether a data folder has a patient list, in it or on the clinic's server."""
    return (folder / STORE_FILE).is_file() or bool(_clinic_places(folder)[0])


def require_store(folder: Path) -> None:
    """Raise :class:`FolderMissing` or :class:`DataFolderMissing` for a folder without a patient list."""
    if not has_store(folder):
        raise errors.DataFolderMissing(folder) if folder.is_dir() else errors.FolderMissing(folder)


def open_store(
    folder: Path, *, read_only: bool = False, on_fault: Callable[[CarpusFault], None] = print_fault
) -> Store:
    """Open the store of a data folder, on the clinic's server if it is this computer's own.

    Raises
    ------
    FolderMissing, DataFolderMissing
        There is no patient list. And the faults of a store.
    """
    from carpus.core.records.store import Store, open_to_read

    require_store(folder)
    url, share = _clinic_places(folder)
    return (open_to_read if read_only else Store)(folder, share, url, on_fault)


def make_server_copier(folder: Path) -> Callable[[], sqlite3.Connection] | None:
    """Return a function that copies a store from the clinic's server, None for a local store."""

    def copy_store() -> sqlite3.Connection:
        with open_store(folder) as store:
            return store.copy_to_memory()

    return copy_store if _clinic_places(folder)[0] else None


def _clinic_places(folder: Path) -> tuple[str, Path | None]:
    """Return server and shared folder of this computer's own data folder; none for another one."""
    settings, _ = load_valid_settings()
    is_own = os.path.realpath(folder) == os.path.realpath(settings.data_folder)
    return (settings.records.url, sessions_folder(settings)) if is_own else ("", None)


def read_choices(path: Path) -> RepetitionChoices:
    """Return excluded and moved repetitions of a session; empty outside a data folder."""
    from carpus.core.results.repetition_rows import RepetitionChoices

    folder = find_data_folder(path)
    if folder is None:
        return RepetitionChoices()
    from carpus.core.records.session_records import read_choices

    with open_store(folder, read_only=True) as store:
        return read_choices(store, read_outline(path).header.session_id)[0]


def read_comment(path: Path) -> str:
    """Return the therapist's latest comment on a session; empty outside a data folder."""
    folder = find_data_folder(path)
    if folder is None:
        return ""
    from carpus.core.records.session_records import read_current_comment

    with open_store(folder, read_only=True) as store:
        return read_current_comment(store, read_outline(path).header.session_id)


def read_report_form(folder: Path) -> ReportForm:
    """Return the report form of a data folder."""
    from carpus.core.records.clinic_records import read_form
    from carpus.core.results.report_form import ReportForm

    if not has_store(folder):
        return ReportForm()
    with open_store(folder, read_only=True) as store:
        return read_form(store)


def find_session_files(places: Sequence[Path]) -> list[Path]:
    """Return session files and those in folders, each once, in order.

    Raises
    ------
    FolderMissing, SessionsMissing
    """
    found: dict[Path, None] = {}
    for place in places:
        if not place.exists():
            raise errors.FolderMissing(place)
        some = sorted(place.rglob("*.h5")) if place.is_dir() else [place]
        found |= dict.fromkeys(path for path in some if path.name != TRUTH_FILE or path == place)
    if not found:
        raise errors.SessionsMissing(next(iter(places), ""))
    return list(found)


def read_results(
    places: Sequence[Path],
    on_fault: Callable[[CarpusFault], object],
    limits: ErrorLimits | None = None,
    is_wanted: Callable[[str], bool] = lambda _: True,
) -> list[tuple[Path, SessionResults]]:
    """Return the session files of some places with their results; those that cannot be read go to ``on_fault``.

    ``is_wanted`` tells by its pseudonym whether a session is read.

    Raises
    ------
    FolderMissing, SessionsMissing
    """
    from carpus.core.measures.change_limits import DEFAULT_LIMITS
    from carpus.core.results.session_results import compute_session_results
    from carpus.core.session.reader import read_session

    found = []
    for path in find_session_files(places):
        try:
            if is_wanted(read_outline(path).header.subject_id):
                results = compute_session_results(read_session(path), read_choices(path), limits or DEFAULT_LIMITS)
                found.append((path, results))
        except CarpusFault as fault:
            on_fault(fault)
    return found


def open_library(folder: Path, *, read_only: bool = False) -> DataFolder:
    """Open the library of a data folder, with the clinic's server and share if it is this computer's own."""
    from carpus.core.records.data_folder import DataFolder

    url, share = _clinic_places(folder)
    library = DataFolder(folder, source="command", url=url, sessions_folder=share, read_only=read_only)
    library.get_initials = user_initials
    library.on_fault = print_fault
    return library


def user_initials() -> str:
    """Return the therapist's initials of the settings."""
    return load_valid_settings()[0].report.therapist


def log_session_action(action: AuditAction, path: Path, session_id: str) -> None:
    """Log what a command does with a session; a failure to log is a warning."""
    folder = find_data_folder(path)
    if folder is not None and Path(os.path.realpath(path)).parent.name != PRACTICE_PATIENT:  # who is in no log
        log_folder_action(folder, action, "session", session_id)


def log_folder_action(
    folder: Path, action: AuditAction, kind: SubjectKind = "program", identity: str = "", **facts: int | str
) -> None:
    """Log what a command does with a data folder; a failure to log is a warning."""
    from carpus.core.records.log import AuditLogWriter

    try:
        with open_store(folder) as store:
            AuditLogWriter(store, "command", user_initials).write_entry(action, kind, identity, **facts)
    except CarpusFault as fault:
        print_fault(fault)


def log_created_files(sessions: Sequence[tuple[Path, str]], files: Sequence[Path], kind: OutputKind) -> None:
    """Log files made from sessions, so that erasing a session can name them."""
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
    """Log exported files, so that erasing a session can name them; de-identified ones are only noted."""
    shared = [path for path in done.files if not any(path in of for of in done.files_by_session.values())]
    for path, own in done.files_by_session.items():
        if find_data_folder(path) is None:
            continue
        session_id = read_outline(path).header.session_id
        if deidentified:
            log_session_action("exported", path, session_id)
        else:
            log_created_files([(path, session_id)], [*own, *shared], "export")
