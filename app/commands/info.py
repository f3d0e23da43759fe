"""``carpus info``: shows details of a recording or session."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import print_fault
from carpus.app.session_commands import log_session_action, read_choices
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.errors import RecordingMissing
from carpus.core.results.session_summary import recording_summary, session_summary, source_summary
from carpus.core.session.reader import read_session

EXAMPLE = "carpus info session.h5"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="session (.h5) or recording (TUM folder, .oni, RealSense or raw)"
    )
    parser.add_argument("--json", action="store_true", help="print only the settings of a session, as JSON")


def run(arguments: argparse.Namespace) -> int:
    path: Path = arguments.file
    if not path.exists():
        raise RecordingMissing(path)
    if path.suffix in {".h5", ".part"}:
        session = read_session(path)
        log_session_action("opened", path, session.header.session_id)
        lines = [session.header.parameters] if arguments.json else session_summary(session, read_choices(path))
    else:
        from carpus.app.sources import open_recording

        source = open_recording(path, need_depth=False, leave_out_damaged=True, notice=print_fault)
        try:
            if isinstance(source, TumFolder):
                lines = recording_summary(path, source)
            else:
                lines = source_summary(path, source.info)
        finally:
            source.close()
    print("\n".join(lines))
    return 0
