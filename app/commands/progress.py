"""``carpus progress`` and ``carpus results``: the measures of many sessions, as one table or a report."""

from __future__ import annotations

import argparse
import csv
import math
import sys
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import (
    add_examples,
    add_region_option,
    output_type,
    print_fault,
    print_json,
    print_table,
    report_usage_error,
)
from carpus.core.model.errors import CarpusFault, OutputExists, PatientUnknown, SessionsMissing
from carpus.core.model.names import describe_known_names, fold_name
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from carpus.app.settings import Settings
    from carpus.core.formats.measures_table import MeasureRow
    from carpus.core.results.session_results import SessionResults

ALL_PATIENTS = "all"
HEAD = ("Session", "Patient", "Date", "Exercise", "Hand", "n", "Arc", "mean", "sd", "Peak speed", "SPARC", "Tracked")


def add_progress_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, 'carpus progress "Fern 12"', "carpus progress all --output measures.csv")
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


def run_progress(arguments: argparse.Namespace) -> int:
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
            from carpus.ui.report.page import write_report
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


def add_results_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus results sessions", "carpus results sessions --output study.csv")
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION.h5", help="session files, or folders with sessions"
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv", ".parquet"),
        metavar="TABLE.csv",
        help="table with one row per session and measure, as .csv or .parquet; an existing file is never overwritten",
    )
    parser.add_argument("--json", action="store_true", help="print the same rows as JSON")
    add_region_option(parser)


def run_results(arguments: argparse.Namespace) -> int:
    if arguments.output is not None and arguments.output.exists():
        raise OutputExists(arguments.output)
    from carpus.app.settings import load_settings
    from carpus.core.formats.measures_table import write_measures

    _, rows = read_measures(ALL_PATIENTS, arguments.sessions, load_settings())
    if arguments.json:
        print_json([asdict(row) for row in rows])
    else:
        sessions: dict[str, list[MeasureRow]] = {}
        for row in rows:
            sessions.setdefault(row.session_id, []).append(row)
        print_table(HEAD, [_summarise(of_session) for of_session in sessions.values()])
    if arguments.output is not None:
        print(f"Written: {write_measures(rows, arguments.output, arguments.form)}")
    return 0


def _summarise(rows: Sequence[MeasureRow]) -> tuple[str, ...]:
    """Return a session's line: the arc of its trained angle, speed and smoothness."""
    first, found = rows[0], {(row.of, row.measure): row for row in rows}
    trained = next((of for of, measure in found if measure == "peak speed"), rows[0].of)

    def show(measure: str, value: str = "mean", decimals: int = 1) -> str:
        number = getattr(found[trained, measure], value) if (trained, measure) in found else math.nan
        return format_rounded(number, decimals) if math.isfinite(number) else "-"

    return (
        first.session, first.subject_id or "-", first.recorded[:10], first.exercise or "-", first.hand,
        str(first.repetitions), trained, show("arc"), show("arc", "sd"), show("peak speed", decimals=0),
        show("smoothness", decimals=2), f"{format_rounded(100.0 * first.tracked_share)} %",
    )  # fmt: skip


def read_measures(
    subject: str, places: list[Path], settings: Settings
) -> tuple[list[SessionResults], list[MeasureRow]]:
    """Return a patient's sessions, each in its newest version, and the rows of all their measures.

    In a data folder the patient list decides who is meant, without archived sessions; elsewhere the pseudonym in each
    file.

    Raises
    ------
    PatientUnknown, SessionsMissing
    CarpusFault
        Of a file, where none can be read.
    """
    from carpus.app.session_commands import has_store, read_results
    from carpus.core.formats.measures_table import build_measure_rows
    from carpus.core.records.clinic_records import read_limits
    from carpus.core.results.progress import select_latest_versions

    limits = read_limits(settings.data_folder)
    found: list[tuple[Path, SessionResults]] = []
    known: list[str] = []
    faults: list[CarpusFault] = []

    def is_wanted(pseudonym: str) -> bool:
        known.append(pseudonym)
        return subject == ALL_PATIENTS or pseudonym.casefold() == subject.strip().casefold()

    for place in places:
        if place.is_dir() and has_store(place):
            found += _read_library_results(subject, place, known, faults.append)
        else:
            found += read_results([place], faults.append, limits, is_wanted)
    last_fault = faults.pop() if faults and not found and subject == ALL_PATIENTS else None
    for fault in faults:
        print_fault(fault)
    if last_fault is not None:
        raise last_fault
    if not found:
        if subject == ALL_PATIENTS or fold_name(subject) in map(fold_name, known):
            raise SessionsMissing(places[0])
        raise PatientUnknown(subject, describe_known_names(subject, sorted({one for one in known if one})))
    figures = select_latest_versions([one for _, one in found])
    names = {id(one): path.stem for path, one in found}
    return figures, [row for one in figures for row in build_measure_rows(one, names[id(one)])]


def _read_library_results(
    subject: str, folder: Path, known: list[str], on_fault: Callable[[CarpusFault], object]
) -> list[tuple[Path, SessionResults]]:
    """Return sessions of a data folder with their results; add the pseudonyms of its patients to ``known``."""
    from carpus.app.session_commands import open_library
    from carpus.core.records.session_list import SessionFileScanner

    with closing(open_library(folder, read_only=True)) as library:
        SessionFileScanner(library.store).scan(reports_faults=False)  # also what was copied in since the last look
        people = {one.patient_id: one.pseudonym for one in library.patients.search(include_archived=True)}
        known += people.values()
        if subject == ALL_PATIENTS:
            wanted = ["", *(one.patient_id for one in library.patients.search())]
        else:
            wanted = [one for one in people if one == library.patients.id_of_pseudonym(subject)]
        out = []
        for patient_id, entry in ((one, entry) for one in wanted for entry in library.sessions(one)):
            try:
                results = library.results(entry)
            except CarpusFault as fault:
                on_fault(fault)
            else:
                out.append((entry.path, replace(results, subject_id=people.get(patient_id, results.subject_id))))
        return out
