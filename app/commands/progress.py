"""``carpus progress``: a patient's results over all sessions, as a table or as a report."""

from __future__ import annotations

import argparse
import csv
import sys
from contextlib import closing
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import add_region_option, output_type, print_fault, print_json, report_usage_error
from carpus.core.measures.change_limits import ErrorLimits
from carpus.core.model.errors import CarpusFault, OutputExists, PatientUnknown, SessionsMissing
from carpus.core.model.names import describe_known_names, fold_name

if TYPE_CHECKING:
    from carpus.app.settings import Settings
    from carpus.core.formats.measures_table import MeasureRow
    from carpus.core.results.session_results import SessionResults

EXAMPLE = """carpus progress "Fern 12"
carpus progress all --output measures.csv"""
ALL_PATIENTS = "all"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "subject", metavar="PSEUDONYM", help="the patient's pseudonym, or “all” for a table of all patients"
    )
    parser.add_argument(
        "--sessions",
        type=Path,
        nargs="+",
        metavar="SESSION.h5",
        help="session files, or folders with sessions (default: those of the data folder)",
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv", ".parquet", ".pdf"),
        action="append",
        default=[],
        metavar="FILE",
        help=".csv or .parquet for the table, .pdf for the progress report; may be given more than once (default: "
        "print CSV)",
    )
    parser.add_argument("--json", action="store_true", help="print the table as JSON instead of CSV")
    add_region_option(parser)


def run(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.core.formats.measures_table import MEASURES_HEADER, to_csv_rows, write_measures

    for path in arguments.output:
        if path.exists():
            raise OutputExists(path)
        if path.suffix.lower() == ".pdf" and arguments.subject == ALL_PATIENTS:
            return report_usage_error("progress", "a report is of one patient; name the pseudonym.")
    settings = load_settings()
    figures, rows = read_measures(arguments.subject, arguments.sessions or [settings.data_folder], settings)
    for path in arguments.output:
        if path.suffix.lower() == ".pdf":
            from carpus.app.session_commands import read_report_form
            from carpus.ui.report.pdf import write_report
            from carpus.ui.report.progress_page import build_progress_report

            form, who = read_report_form(settings.data_folder), arguments.subject
            report = build_progress_report(figures, pseudonym=who, therapist=settings.report.therapist, form=form)
            write_report(report, path)
        else:
            write_measures(rows, path, arguments.form)
        print(f"Written: {path}")
    if arguments.json:
        print_json([asdict(row) for row in rows])
    elif not arguments.output:
        table = csv.writer(sys.stdout, lineterminator="\n")
        table.writerow(MEASURES_HEADER)
        table.writerows(to_csv_rows(rows))
    return 0


def read_measures(
    subject: str, places: list[Path], settings: Settings
) -> tuple[list[SessionResults], list[MeasureRow]]:
    """Return a patient's sessions, each in its newest version, and the rows of all their measures."""
    from carpus.core.formats.measures_table import build_measure_rows
    from carpus.core.records.clinic_records import read_limits
    from carpus.core.results.progress import select_latest_versions

    found = _find_figures(subject, places, read_limits(settings.data_folder))
    figures = select_latest_versions([one for _, one in found])
    names = {id(one): path.stem for path, one in found}
    return figures, [row for one in figures for row in build_measure_rows(one, names[id(one)])]


def _find_figures(subject: str, places: list[Path], limits: ErrorLimits) -> list[tuple[Path, SessionResults]]:
    """Return the readable sessions of a patient with their results.

    In a data folder the patient list decides who is meant, without archived sessions; elsewhere the pseudonym in each
    file.

    Raises
    ------
    PatientUnknown, SessionsMissing
    """
    from carpus.app.session_commands import has_store

    out: list[tuple[Path, SessionResults]] = []
    known: list[str] = []
    for place in places:
        has_list = place.is_dir() and has_store(place)
        found, names = _figures_in_library(subject, place) if has_list else _figures_in_files(subject, place, limits)
        out += found
        known += names
    if not out:
        if subject == ALL_PATIENTS or fold_name(subject) in map(fold_name, known):
            raise SessionsMissing(places[0])
        raise PatientUnknown(subject, describe_known_names(subject, sorted({one for one in known if one})))
    return out


def _figures_in_library(subject: str, folder: Path) -> tuple[list[tuple[Path, SessionResults]], list[str]]:
    """Return sessions of a data folder with their results, and the pseudonyms of its patients."""
    from carpus.app.session_commands import open_library
    from carpus.core.records.session_list import SessionFileScanner

    with closing(open_library(folder, read_only=True)) as library:
        SessionFileScanner(library.store).scan(reports_faults=False)  # also what was copied in since the last look
        people = {one.patient_id: one.pseudonym for one in library.patients.search(include_archived=True)}
        if subject == ALL_PATIENTS:
            wanted = ["", *(one.patient_id for one in library.patients.search())]
        else:
            wanted = [one for one in people if one == library.patients.id_of_pseudonym(subject)]
        out = []
        for patient_id in wanted:
            for entry in library.sessions(patient_id):
                try:
                    figures = library.results(entry)
                except CarpusFault as fault:
                    print_fault(fault)
                else:
                    out.append((entry.path, replace(figures, subject_id=people.get(patient_id, figures.subject_id))))
        return out, list(people.values())


def _figures_in_files(
    subject: str, place: Path, limits: ErrorLimits
) -> tuple[list[tuple[Path, SessionResults]], list[str]]:
    """Return sessions outside a data folder with their results, and all pseudonyms in the files."""
    from carpus.app.session_commands import find_session_files, read_choices
    from carpus.core.results.session_results import compute_session_results
    from carpus.core.session.reader import read_outline, read_session

    out = []
    known: list[str] = []
    for path in find_session_files([place]):
        try:
            said = read_outline(path).header.subject_id
            known.append(said)
            if subject == ALL_PATIENTS or said.casefold() == subject.strip().casefold():
                out.append((path, compute_session_results(read_session(path), read_choices(path), limits)))
        except CarpusFault as fault:
            print_fault(fault)
    return out, known
