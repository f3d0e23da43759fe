"""``carpus progress``: a patient's figures over all sessions, as a table or as the progress report."""

from __future__ import annotations

import argparse
import csv
import sys
from pathlib import Path

from carpus import __version__
from carpus.app.command_line import misused, tell
from carpus.core.errors import CarpusFault, OutputExists, PatientUnknown, SessionsMissing
from carpus.core.measures.change import ErrorLimits
from carpus.core.names import known_names

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
            from carpus.core.records.of_clinic import form_in
            from carpus.ui.report.pdf import ensure_application, write_progress_report

            application = ensure_application()
            write_progress_report(
                figures, path, pseudonym=arguments.subject, therapist=settings.report.therapist,
                software_version=__version__, form=form_in(settings.data_folder),
            )  # fmt: skip
            del application
        else:
            write_measures(rows, path)
        print(f"Written: {path}")
    if not arguments.output:
        table = csv.writer(sys.stdout, lineterminator="\n")
        table.writerow(HEAD)
        table.writerows(csv_rows(rows))
    return 0


def _of(subject: str, places: list[Path], limits: ErrorLimits) -> list:  # type: ignore[type-arg]
    """Sessions of a patient that can be read, with their figures. Raises :class:`PatientUnknown` or
    :class:`SessionsMissing` for none."""
    from carpus.app.of_file import read_choices, sessions_in
    from carpus.core.results.camera_said import folder_with_checks
    from carpus.core.results.figures import session_figures, with_trust
    from carpus.core.session.reader import read_outline, read_session

    out = []
    known: list[str] = []
    for path in sessions_in(places):
        try:
            said = read_outline(path).header.subject_id
            known.append(said)
            if subject == EVERYBODY or said.casefold() == subject.strip().casefold():
                figures = session_figures(read_session(path), read_choices(path), limits)
                out.append((path, with_trust(figures, folder_with_checks(path))))
        except CarpusFault as fault:
            tell(fault)
    if not out:
        if subject == EVERYBODY:
            raise SessionsMissing(places[0])
        names = sorted({one for one in known if one})
        raise PatientUnknown(subject, known_names(subject, names))
    return out
