"""``python -m tests.second_patient --output FOLDER --row NAME --seed N``: a recording of the second patient."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tests.second_patient.motions import ROWS, SECONDS, row_named
from tests.second_patient.recording import recorded, take_of


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.second_patient", description=__doc__)
    parser.add_argument("--output", type=Path, help="folder to make; must not be there")
    parser.add_argument("--row", default=ROWS[0].name, metavar="NAME", help="which row; --list names them")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--hand", choices=("right", "left"), help="side, else by the seed: even is right")
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--list", action="store_true", help="name the rows and stop")
    options = parser.parse_args()
    if options.list:
        print("\n".join(row.name for row in ROWS))
        return 0
    if options.output is None:
        parser.error("--output FOLDER is missing")
    if options.output.exists():
        print(f"{options.output} is there already: choose another folder", file=sys.stderr)
        return 1
    try:
        row = row_named(options.row)
    except ValueError as cause:
        parser.error(str(cause))
    truth = recorded(take_of(row, options.seed, options.hand, options.seconds), options.output)
    print(f"{options.output}: {row.name}, {truth.side} hand, {len(truth.timestamp_s)} frames")
    return 0


if __name__ == "__main__":
    sys.exit(main())
