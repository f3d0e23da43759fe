"""``python -m tests.accuracy``: the errors of Carpus against simulated truth, beside the simplest thing and the bound.

Every figure is synthetic: simulated hands, simulated camera.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence

from tests.accuracy import hand21_table
from tests.accuracy.jobs import all_runs, jobs_for
from tests.accuracy.robustness import robustness_verdicts
from tests.accuracy.scenarios import GROUPS
from tests.accuracy.table import markdown, rows_of, terminal
from tests.accuracy.targets import verdicts

QUICK_SEEDS = 3


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.accuracy", description=__doc__)
    parser.add_argument("--group", choices=("all", *GROUPS, "hand"), default="all", help="which rows")
    parser.add_argument("--only", default="", metavar="TEXT", help="rows whose name holds this")
    parser.add_argument(
        "--seeds", type=int, default=10, help="simulated recordings a row (the fast row takes three times)"
    )
    parser.add_argument("--pictures", type=int, default=1, help="rendered recordings a row, 0 for none")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK_SEEDS} seeds and no pictures")
    parser.add_argument("--markdown", action="store_true", help="the table of the README instead")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args(arguments)
    seeds, pictures = (QUICK_SEEDS, 0) if options.quick else (options.seeds, options.pictures)
    hand = hand21_table.rows_named(options.only) if options.group in ("all", "hand") else []
    if options.group == "hand":
        print(hand21_table.report(hand, seeds, pictures, options.processes, as_markdown=options.markdown))
        return 0 if hand else 2
    groups = GROUPS.values() if options.group == "all" else (GROUPS[options.group],)
    scenarios = [row for group in groups for row in group if options.only.lower() in row.name.lower()]
    if not scenarios and not hand:
        print(f"no row of {options.group} is named like {options.only}", file=sys.stderr)
        return 2
    begin = time.monotonic()
    runs = all_runs(jobs_for(scenarios, seeds, pictures), options.processes)
    rows = list(rows_of(runs, scenarios))
    if options.markdown:
        print(markdown(rows))
    else:
        print(terminal(rows))
    print("\nSynthetic: simulated hands before a simulated camera. What was promised:")
    for verdict in (*verdicts(runs, scenarios), *robustness_verdicts(runs, scenarios)):
        print(verdict)
    if hand:
        print()
        print(hand21_table.report(hand, seeds, pictures, options.processes, as_markdown=options.markdown))
    print(f"{time.monotonic() - begin:.0f} s", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
