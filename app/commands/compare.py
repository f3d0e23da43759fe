"""``carpus compare``: how far a session agrees with another measurement of the same movement."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path

from carpus import __version__
from carpus.core.agreement.compare import MOST_SHIFT_S
from carpus.core.hand.sites import SITES


def mapping(text: str) -> dict[str, str]:
    """``NAME=VALUE,...``; anything else is wrong usage."""
    pairs = [part.split("=", 1) for part in text.split(",") if part.strip()]
    if not pairs or any(len(pair) != 2 or not pair[0].strip() or not pair[1].strip() for pair in pairs):
        raise argparse.ArgumentTypeError(f"{text!r} is not made of NAME=THEIRS,...")
    return {name.strip(): value.strip() for name, value in pairs}


def marker_mapping(text: str) -> dict[str, str]:
    """As :func:`mapping`, of discs."""
    found = {name.upper(): value for name, value in mapping(text).items()}
    unknown = [name for name in found if name not in SITES]
    if unknown:
        raise argparse.ArgumentTypeError(f"{', '.join(unknown)}: no such disc; they are {', '.join(SITES)}")
    return found


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("session", type=Path, metavar="SESSION.h5")
    parser.add_argument(
        "reference",
        type=Path,
        metavar="REFERENCE",
        help="C3D, TRC, MOT, CSV table, CSV list of readings (angle or movement, reading_deg, time_s), or session",
    )
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="tables and plots; nothing in it is overwritten")
    parser.add_argument(
        "--columns",
        type=mapping,
        default={},
        metavar="ANGLE=COLUMN,...",
        help="which column is which angle (deviation, flexion, pronosupination, joints) or time; -COLUMN: other sign",
    )
    parser.add_argument(
        "--markers", type=marker_mapping, default={}, metavar="DISC=MARKER,...", help="which marker is which disc"
    )
    parser.add_argument("--unit", choices=("deg", "rad"), help="of the reference's angles, where it does not say")
    parser.add_argument("--smoothed", action="store_true", help="compare the smoother's results, not the filter's")
    parser.add_argument(
        "--max-shift", type=float, default=MOST_SHIFT_S, metavar="S", help="furthest that the clocks are apart"
    )


def run(arguments: argparse.Namespace) -> int:
    from carpus.core.agreement.compared_files import compare_files, write_files
    from carpus.core.agreement.tables import lines
    from carpus.core.library.library import read_choices

    radians: bool | None = None if arguments.unit is None else arguments.unit == "rad"
    columns: Mapping[str, str] = arguments.columns
    result = compare_files(
        arguments.session,
        arguments.reference,
        columns=columns,
        markers=arguments.markers,
        radians=radians,
        smoothed=arguments.smoothed,
        most_shift_s=arguments.max_shift,
        choices=read_choices(arguments.session),
    )
    for line in lines(result.compared):
        print(line)
    if arguments.output is not None:
        for path in write_files(result, arguments.output, __version__):
            print(f"Written: {path}")
        from carpus.ui.report.agreement_plot import write_plots

        for path in write_plots(result.compared, arguments.output, result.stem):
            print(f"Written: {path}")
    return 0
