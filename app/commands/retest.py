"""``carpus retest``: SEM and MDC95 from people who were measured more than once.

With ``--store`` they become the clinic's own error limits.
"""

from __future__ import annotations

import argparse
import math
from collections import Counter
from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import (
    add_examples,
    add_region_option,
    output_type,
    print_fault,
    print_json,
    print_message,
)
from carpus.app.session_commands import read_results
from carpus.core.model.errors import ReferenceUnreadable, StudyUnsuited
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from carpus.core.research.agreement.retest import RetestAnalysis
    from carpus.core.results.session_results import SessionResults

_REASONS = {
    "once": "person measured once",
    "too_late": "more than 14 days after the first time",
    "few_repetitions_after": "fewer than 3 repetitions",
    "distance": "camera at another distance",
    "start_angle": "another start angle",
    "forearm_moved": "the forearm moved",
    "doubtful": "doubtful markers",
    "not_counted": "marked as not counting",
    "simulated": "simulated among measured ones",
}


def add_retest_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus retest sessions --output retest.csv")
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION.h5",
        help="session files, or folders with sessions. Each person (pseudonym) is measured at least twice, with the "
             "markers replaced in between",
    )  # fmt: skip
    parser.add_argument(
        "--raters",
        type=Path,
        metavar="TABLE.csv",
        help="table of who placed the markers, with the columns session (file name) and rater",
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv"),
        metavar="TABLE.csv",
        help="table of all values; an existing file is never overwritten",
    )
    parser.add_argument(
        "--store",
        action="store_true",
        help="use these MDC values from today in progress and reports of the data folder",
    )
    parser.add_argument("--json", action="store_true", help="print the values as JSON")
    add_region_option(parser)


def run_retest(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.core.records.clinic_records import save_limits
    from carpus.core.research.agreement.retest import analyse_retests, list_retests, write_retests

    results = read_results(arguments.sessions, print_fault)
    if not results:
        raise StudyUnsuited(arguments.sessions[0], "no session can be read")
    found = analyse_retests([one for _, one in results], _find_raters(arguments.raters, results))
    if arguments.json:
        print_json(list_retests(found))
    else:
        _print_analyses(found)
    if arguments.output is not None:
        print(f"Written: {write_retests(found, arguments.output, arguments.form)}")
    usable = [one for one in found if one.is_usable]
    if not any(one.people > 1 for one in found):
        raise StudyUnsuited(arguments.sessions[0], "nobody was measured twice, or fewer than two people were")
    if not arguments.store:
        return 0
    if not usable:
        most = max(one.people for one in found)
        why = "of a simulated hand" if any(one.simulated for one in found) else f"{most} people"
        raise StudyUnsuited(arguments.sessions[0], why)
    path = save_limits(load_settings().data_folder, [one.to_study(date.today().isoformat()) for one in usable])
    print(f"In force: {', '.join(one.exercise or 'free movement' for one in usable)} ({path})")
    return 0


def _print_analyses(found: Sequence[RetestAnalysis]) -> None:
    for one in found:
        who = f", {one.raters} raters" if one.raters else ""
        print(f"{one.exercise or 'free movement'}, {one.protocol}: {one.people} people, {one.sessions} sessions{who}")
        if one.excluded:
            reasons = Counter(_REASONS.get(left.reason, left.reason) for left in one.excluded)
            print(f"  excluded: {', '.join(f'{count} ({reason})' for reason, count in reasons.items())}")
        if one.results:
            print(
                f"  {'degrees':26} {'n':>3}    SEM   MDC95 (95 % interval)    {'ICC(2,1) (interval)':20}   "
                f"{'ICC(3,1) (interval)':20}   last - first   SEM of one rater"
            )
        for (of, movement), f in one.results.items():
            mdc = (
                f"{f.mdc95:5.1f} ({format_rounded(f.mdc95_interval[0], 1)} to {format_rounded(f.mdc95_interval[1], 1)})"
            )
            iccs = [
                f"{format_rounded(icc, 2)} ({format_rounded(low, 2)} to {format_rounded(high, 2)})"
                for icc, (low, high) in ((f.icc, f.icc_interval), (f.icc_3_1, f.icc_3_1_interval))
            ]
            own = format_rounded(f.intra_rater_sem, 2) if math.isfinite(f.intra_rater_sem) else "-"
            print(
                f"  {f'{of} {movement}':26} {f.people:3d}  {f.sem:5.2f}   {mdc:22}   {iccs[0]:20}   {iccs[1]:20}   "
                f"{f.systematic_change:12.2f}   {own}"
            )


def _find_raters(path: Path | None, sessions: Sequence[tuple[Path, SessionResults]]) -> dict[str, str]:
    """Return the raters of a table by session id."""
    if path is None:
        return {}
    from carpus.core.formats.table_read import read_table

    table = read_table(path, ("session", "rater"))
    if not {name.lower() for name in table.names} >= {"session", "rater"}:
        raise ReferenceUnreadable(path, "a list of raters has the columns session and rater")
    raters = {row["session"]: row["rater"] for row in map(table.row, range(len(table.rows)))}
    names = [(name, one.session_id) for file, one in sessions for name in (file.name, file.stem)]
    for name in sorted(raters.keys() - {name for name, _ in names}):
        print_message(f"no session is called {name}, which the list of raters names.")
    return {session_id: raters[name] for name, session_id in names if name in raters}
