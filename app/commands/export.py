"""``carpus export``: sessions in open formats."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import add_examples, add_region_option, print_fault, progress_bar
from carpus.core.formats.export import FORMATS
from carpus.core.model.names import describe_known_names

ALL = "all"


def parse_formats(text: str) -> tuple[str, ...]:
    """Parse names of formats, separated by commas; an unknown one is wrong usage."""
    names = tuple(dict.fromkeys(name.strip().lower() for name in text.split(",") if name.strip()))
    unknown = [name for name in names if name not in (*FORMATS, ALL)]
    if unknown or not names:
        word = next(iter(unknown), text)
        raise argparse.ArgumentTypeError(f"no format is called “{word}”; {describe_known_names(word, (*FORMATS, ALL))}")
    return tuple(FORMATS) if ALL in names else names


def add_export_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus export session.h5 --format csv,c3d --output out/export")
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION.h5", help="session files, or folders with sessions"
    )
    parser.add_argument(
        "--format",
        type=parse_formats,
        default=("csv",),
        metavar="FORMAT,...",
        help="; ".join(f"{name}: {kind.description}" for name, kind in FORMATS.items()) + f"; {ALL} of them",
    )
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="FOLDER",
        help="folder for the exported files; existing files are never overwritten",
    )
    add_region_option(parser)
    parser.add_argument(
        "--deidentified",
        action="store_true",
        help="use new random names, count days from each patient's first session, and leave out all texts and the "
        "camera details",
    )


def run_export(arguments: argparse.Namespace) -> int:
    from carpus.app.session_commands import find_session_files, log_export, read_choices
    from carpus.core.formats.export import ExportRequest, export_sessions

    paths = find_session_files(arguments.sessions)
    with progress_bar("exporting", "file") as progress:
        done = export_sessions(
            [ExportRequest.from_file(path, read_choices) for path in paths],
            arguments.output,
            arguments.format,
            deidentified=arguments.deidentified,
            dialect=arguments.form,
            progress=progress,
        )
    for refused in done.refused:
        print_fault(refused.fault)
    log_export(done, deidentified=arguments.deidentified)
    for path in done.files if len(paths) == 1 else ():
        print(f"Written: {path}")
    count = len(done.files)
    if len(paths) > 1 and count:
        print(f"Written: {count} files of {len(paths) - len(done.refused)} sessions into {arguments.output}")
    return 1 if done.refused else 0
