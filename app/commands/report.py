"""``carpus report``: the report of a session, or of several, as PDF."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.settings import load_settings
from core.errors import OutputExists
from core.session.reader import read_session


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("sessions", type=Path, nargs="+", metavar="SESSION.h5")
    parser.add_argument("--output", type=Path, required=True, metavar="REPORT.pdf", help="never overwritten")


def run(arguments: argparse.Namespace) -> int:
    if arguments.output.exists():
        raise OutputExists(arguments.output)
    sessions = [read_session(path) for path in arguments.sessions]
    therapist = load_settings().report.therapist
    # Qt is loaded only now: a wrong file is told without it.
    from core.output.report_content import session_figures
    from ui.report.pdf import ensure_application, write_progress_report, write_session_report

    application = ensure_application()
    if len(sessions) == 1:
        write_session_report(sessions[0], arguments.output, therapist=therapist)
    else:
        figures = [session_figures(session) for session in sessions]
        write_progress_report(figures, arguments.output, therapist=therapist)
    del application
    print(f"Report: {arguments.output}")
    return 0
