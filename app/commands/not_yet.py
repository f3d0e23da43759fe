"""Commands that Carpus will have and does not have yet: they say so."""

from __future__ import annotations

import argparse
import sys

NOT_YET = {
    "compare": "Agreement with a reference measurement. Not there yet.",
    "calibrate-camera": "Intrinsics from a printed board. Not there yet.",
}
INSTEAD = {
    "compare": "carpus export writes the angles as CSV, to be compared elsewhere",
    "calibrate-camera": "a camera_info.yaml made by another program is read beside a recording",
}


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """None yet."""


def run(arguments: argparse.Namespace) -> int:
    name = arguments.command
    print(f"carpus: {name} is not there yet; {INSTEAD[name]}.", file=sys.stderr)
    return 1
