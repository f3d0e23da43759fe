"""``carpus log``: shows the log of a data folder: who did what, and when."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import output_type, print_fault, print_message
from carpus.app.session_commands import open_store
from carpus.app.settings import load_valid_settings
from carpus.core.model.errors import CarpusFault, OutputExists, PatientListDamaged

EXAMPLE = "carpus log --output log.csv"
HEAD = ("number", "when", "who", "by", "did", "kind", "subject", "facts")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder with patients and sessions (default: your own)"
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv"),
        metavar="TABLE.csv",
        help="write the log to this table; an existing file is never overwritten",
    )


def run(arguments: argparse.Namespace) -> int:
    from carpus.core.formats.output_files import require_folder, write_new_table
    from carpus.core.records.log import read_log

    settings, _ = load_valid_settings()
    folder: Path = arguments.data_folder or settings.data_folder
    if arguments.output is not None:
        if arguments.output.exists():
            raise OutputExists(arguments.output)
        require_folder(arguments.output)
    faults: list[CarpusFault] = []
    with open_store(folder, read_only=True, on_fault=faults.append) as store:
        deeds = read_log(store)
    for fault in faults:
        if not isinstance(fault, PatientListDamaged):
            print_fault(fault)
        else:
            print_message(f"a line is damaged and left out ({fault.detail}).")
    rows = []
    for deed in deeds:
        facts = " ".join(f"{name}={value}" for name, value in deed.facts.items())
        when = deed.when.astimezone().isoformat(timespec="seconds")
        rows.append((f"{deed.number}", when, deed.initials, deed.source, deed.action, deed.kind, deed.subject, facts))
    if arguments.output is not None:
        write_new_table(arguments.output, HEAD, rows)
        print(f"Written: {arguments.output}")
        return 0
    for number, when, who, by, did, kind, subject, facts in rows:
        print(f"{number:>6}  {when}  {who or '-':12}  {by:7}  {did:15} {kind} {subject} {facts}".rstrip())
    print(f"{len(rows)} lines.")
    return 0
