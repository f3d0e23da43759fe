"""``carpus progress``: a patient's figures over all sessions, as a table or as the progress report."""

from __future__ import annotations

import argparse
import csv
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import add_region, misused, tell
from carpus.core.errors import CarpusFault, OutputExists, PatientUnknown, SessionsMissing
from carpus.core.measures.change import ErrorLimits
from carpus.core.names import folded, known_names

if TYPE_CHECKING:
    from carpus.core.results.figures import SessionFigures

EXAMPLE = """carpus progress "Fern 12"
carpus progress all --output measures.csv"""
EVERYBODY = "all"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("subject", metavar="PSEUDONYM", help="the patient's pseudonym; all: of everybody, as a table")
    parser.add_argument(
        "--sessions",
        type=Path,
        nargs="+",
        metavar="SESSION.h5",
        help="sessions, or folders of them; else the data folder's",
    )
    parser.add_argument(
        "--output",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help=".csv or .parquet: the table; .pdf: the progress report; may be given more than once; else CSV on stdout",
    )
    add_region(parser)


def run(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.core.agreement.limits_file import read_limits
    from carpus.core.formats.measures_files import HEAD, csv_rows, write_measures
    from carpus.core.results.measures_table import measure_rows
    from carpus.core.results.progress import newest_results

    for path in arguments.output:
        if path.exists():
            raise OutputExists(path)
        if path.suffix.lower() == ".pdf" and arguments.subject == EVERYBODY:
            return misused("progress", "a report is of one patient; name the pseudonym.")
    settings = load_settings()
    places = arguments.sessions or [settings.data_folder]
    found = _of(arguments.subject, places, read_limits(settings.data_folder))
    figures = newest_results([one for _, one in found])
    names = {id(one): path.stem for path, one in found}
    rows = [row for one in figures for row in measure_rows(one, names[id(one)])]
    for path in arguments.output:
        if path.suffix.lower() == ".pdf":
            from carpus.app.of_file import form_of
            from carpus.ui.report.gather import write_progress_report
            from carpus.ui.report.pdf import ensure_application

            application = ensure_application()
            write_progress_report(
                figures, path, pseudonym=arguments.subject, therapist=settings.report.therapist,
                form=form_of(settings.data_folder),
            )  # fmt: skip
            del application
        else:
            write_measures(rows, path, arguments.form)
        print(f"Written: {path}")
    if not arguments.output:
        table = csv.writer(sys.stdout, lineterminator="\n")
        table.writerow(HEAD)
        table.writerows(csv_rows(rows))
    return 0


def _of(subject: str, places: list[Path], limits: ErrorLimits) -> list[tuple[Path, SessionFigures]]:
    """Sessions of a patient that can be read, with their figures: of a data folder those that the list of patients has
    as this patient's and not in the archive, of any other the files that carry the pseudonym. Raises
    :class:`PatientUnknown` or :class:`SessionsMissing` for none."""
    from carpus.app.of_file import has_store

    out: list[tuple[Path, SessionFigures]] = []
    known: list[str] = []
    for place in places:
        has_list = place.is_dir() and has_store(place)
        found, names = _listed(subject, place) if has_list else _carrying(subject, place, limits)
        out += found
        known += names
    if not out:
        if subject == EVERYBODY or folded(subject) in map(folded, known):
            raise SessionsMissing(places[0])
        raise PatientUnknown(subject, known_names(subject, sorted({one for one in known if one})))
    return out


def _listed(subject: str, folder: Path) -> tuple[list[tuple[Path, SessionFigures]], list[str]]:
    """Of a data folder; and the pseudonyms of its patients."""
    from carpus.app.of_file import library_of
    from carpus.core.records.session_list import FilesOfSessions

    with closing(library_of(folder, only_reads=True)) as library:
        FilesOfSessions(library.store).take_in(tells=False)  # also what was copied in since the last look
        people = {one.patient_id: one.pseudonym for one in library.patients.listed(archived=True)}
        if subject == EVERYBODY:
            wanted = ["", *(one.patient_id for one in library.patients.listed())]
        else:
            wanted = [one for one in people if one == library.patients.called(subject)]
        out = []
        for patient_id in wanted:
            for entry in library.sessions(patient_id):
                try:
                    figures = library.figures(entry)
                except CarpusFault as fault:
                    tell(fault)
                else:
                    out.append((entry.path, replace(figures, subject_id=people.get(patient_id, figures.subject_id))))
        return out, list(people.values())


def _carrying(subject: str, place: Path, limits: ErrorLimits) -> tuple[list[tuple[Path, SessionFigures]], list[str]]:
    """Of files that lie in no data folder, or are named one by one; and every pseudonym that they carry."""
    from carpus.app.of_file import read_choices, sessions_in
    from carpus.core.results.figures import session_figures
    from carpus.core.session.reader import read_outline, read_session

    out = []
    known: list[str] = []
    for path in sessions_in([place]):
        try:
            said = read_outline(path).header.subject_id
            known.append(said)
            if subject == EVERYBODY or said.casefold() == subject.strip().casefold():
                out.append((path, session_figures(read_session(path), read_choices(path), limits)))
        except CarpusFault as fault:
            tell(fault)
    return out, known
