"""``carpus report``: the report of a session, or the progress report of several, as PDF."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from carpus.app.command_line import add_examples, output_type, print_message
from carpus.app.session_commands import log_created_files
from carpus.app.settings import ANGLE_ORDERS, load_settings
from carpus.core.model.errors import OutputExists
from carpus.core.model.phrase import LANGUAGES
from carpus.core.results.ranges import with_angle_order
from carpus.core.results.report_form import PAPERS
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session


def add_report_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus report session.h5 --output report.pdf --language de")
    parser.add_argument("sessions", type=Path, nargs="+", metavar="SESSION.h5")
    parser.add_argument(
        "--output",
        type=output_type(".pdf"),
        required=True,
        metavar="REPORT.pdf",
        help="PDF file to write; an existing file is never overwritten",
    )
    parser.add_argument(
        "--angle-order",
        choices=ANGLE_ORDERS,
        help="order of the wrist angles: zyx (as published, deviation first) or isb (flexion first) (default: from "
        "the settings)",
    )
    parser.add_argument("--paper", choices=PAPERS, help="paper size (default: from the settings)")
    parser.add_argument(
        "--language", choices=tuple(LANGUAGES), default="", help="language of the report (default: English)"
    )


def run_report(arguments: argparse.Namespace) -> int:
    if arguments.output.exists():
        raise OutputExists(arguments.output)
    settings = load_settings()
    order = arguments.angle_order or settings.report.angle_order
    named: dict[str, Session] = {}
    for path in arguments.sessions:
        session = with_angle_order(read_session(path), order)
        if named.setdefault(session.header.session_id, session) is not session:
            print_message(f"{path} is left out: it holds a session that was named before.")
    sessions = list(named.values())
    from carpus.app.session_commands import read_choices, read_comment, read_report_form

    form = read_report_form(settings.data_folder)
    if arguments.paper:
        form = replace(form, paper=arguments.paper)
    look = {"form": form, "language": arguments.language, "therapist": settings.report.therapist}
    # Qt is loaded only now: a wrong file is told without it.
    from carpus.core.records.clinic_records import read_limits
    from carpus.core.results.progress import select_latest_versions
    from carpus.core.results.session_results import compute_session_results
    from carpus.ui.report.page import Report, write_report
    from carpus.ui.report.progress_page import build_progress_report
    from carpus.ui.report.session_page import build_session_report

    choices = [read_choices(one.path) for one in sessions]
    report: Report
    if len(sessions) == 1:
        report = build_session_report(sessions[0], choices=choices[0], comment=read_comment(sessions[0].path), **look)
    else:
        limits = read_limits(settings.data_folder)
        figures = [compute_session_results(*one, limits) for one in zip(sessions, choices, strict=True)]
        for older in {one.session_id for one in figures} - {one.session_id for one in select_latest_versions(figures)}:
            print_message(f"session {older} is left out: a newer result of its recording counts.")
        report = build_progress_report(figures, **look)
    write_report(report, arguments.output)
    log_created_files([(one.path, one.header.session_id) for one in sessions], [arguments.output], "report")
    print(f"Report: {arguments.output}")
    return 0
