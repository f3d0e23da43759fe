"""``carpus compare``: agreement of a session with another measurement of the same movement."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from carpus.app.command_line import add_examples, add_region_option, number_type, print_json, report_usage_error
from carpus.core.model.hand.protocols import SITES
from carpus.core.model.names import describe_known_names
from carpus.core.research.agreement.compare import DEFAULT_MAX_SHIFT_S, MAX_DRIFT_PERCENT, MAX_SHIFT_S

MAX_LIMIT_DEG = 90.0


def parse_mapping(text: str) -> dict[str, str]:
    """Parse ``NAME=VALUE,...``; anything else is wrong usage."""
    pairs = [part.split("=", 1) for part in text.split(",") if part.strip()]
    if not pairs or any(len(pair) != 2 or not pair[0].strip() or not pair[1].strip() for pair in pairs):
        raise argparse.ArgumentTypeError(f"{text!r} is not made of NAME=THEIRS,...")
    return {name.strip(): value.strip() for name, value in pairs}


def parse_marker_mapping(text: str) -> dict[str, str]:
    """Parse ``MARKER=NAME,...``; an unknown marker is wrong usage."""
    found = {name.upper(): value for name, value in parse_mapping(text).items()}
    unknown = [name for name in found if name not in SITES]
    if unknown:
        raise argparse.ArgumentTypeError(
            f"no marker is called “{unknown[0]}”; {describe_known_names(unknown[0], SITES)}"
        )
    return found


def add_compare_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus compare session.h5 reference.c3d --output out/agreement")
    parser.add_argument("session", type=Path, nargs="?", metavar="SESSION.h5")
    parser.add_argument(
        "reference",
        type=Path,
        nargs="?",
        metavar="REFERENCE",
        help="reference measurement: C3D, TRC, MOT, a CSV table of angles, a CSV list of goniometer readings "
        "(columns angle or movement, reading_deg, time_s), or another session",
    )
    parser.add_argument(
        "--study", type=Path, metavar="TABLE.csv",
        help="compare several people and sessions: a table with the columns person, session and reference, and if "
             "needed columns, markers, unit, lag_s and drift_percent",
    )  # fmt: skip
    parser.add_argument(
        "--output",
        type=Path,
        metavar="FOLDER",
        help="folder for tables and plots; existing files are never overwritten",
    )
    parser.add_argument("--json", action="store_true", help="print the values of one session as JSON")
    add_region_option(parser)
    parser.add_argument(
        "--columns",
        type=parse_mapping,
        default={},
        metavar="ANGLE=COLUMN,...",
        help="columns of the reference for the angles (deviation, flexion, pronosupination, joints) and the time; "
        "-COLUMN reverses the sign",
    )
    parser.add_argument(
        "--markers",
        type=parse_marker_mapping,
        default={},
        metavar="MARKER=NAME,...",
        help="names of the Carpus markers in the reference",
    )
    parser.add_argument(
        "--unit", choices=("deg", "rad"), help="unit of the reference's angles, if the file does not state it"
    )
    parser.add_argument(
        "--smoothed", action="store_true", help="compare the smoothed results instead of the live results"
    )
    parser.add_argument(
        "--max-shift", type=number_type(0.0, MAX_SHIFT_S, "seconds"), default=DEFAULT_MAX_SHIFT_S, metavar="SECONDS",
        help="largest time shift between the two clocks to search for",
    )  # fmt: skip
    parser.add_argument(
        "--lag",
        type=number_type(-MAX_SHIFT_S, MAX_SHIFT_S, "seconds"),
        default=math.nan,
        metavar="SECONDS",
        help="known time shift: how much later the same event has on the reference's clock. No shift is searched for",
    )
    parser.add_argument(
        "--drift", type=number_type(-MAX_DRIFT_PERCENT, MAX_DRIFT_PERCENT, "percent"), default=0.0,
        metavar="PERCENT", help="how much faster the reference's clock runs; the comparison corrects for it",
    )  # fmt: skip
    parser.add_argument(
        "--limit", type=number_type(0.0, MAX_LIMIT_DEG, "degrees"), default=0.0, metavar="DEGREES",
        help="acceptable difference, set before comparing. Each angle is assessed against it, and the plots show it",
    )  # fmt: skip


def run_compare(arguments: argparse.Namespace) -> int:
    if arguments.study is not None:
        return _compare_study(arguments)
    if arguments.reference is None:
        return report_usage_error("compare", "a session and its reference are needed, or --study TABLE.csv.")
    from carpus.app.session_commands import read_choices
    from carpus.core.research.agreement.agreement_files import (
        compare_files,
        format_comparison,
        format_limit_verdicts,
        to_json,
        write_comparison,
    )

    radians: bool | None = None if arguments.unit is None else arguments.unit == "rad"
    columns: Mapping[str, str] = arguments.columns
    result = compare_files(
        arguments.session,
        arguments.reference,
        columns=columns,
        markers=arguments.markers,
        radians=radians,
        smoothed=arguments.smoothed,
        max_shift_s=arguments.max_shift,
        lag_s=arguments.lag,
        drift=0.01 * arguments.drift,
        choices=read_choices(arguments.session),
    )
    if arguments.json:
        print_json(to_json(result))
    else:
        verdicts = format_limit_verdicts(result.comparison.pairs, arguments.limit)
        print("\n".join([*format_comparison(result.comparison), *verdicts]))
    if arguments.output is not None:
        for path in write_comparison(result, arguments.output, arguments.form):
            print(f"Written: {path}")
        from carpus.ui.report.agreement_plot import write_plots

        for path in write_plots(result.comparison, arguments.output, result.stem, arguments.limit):
            print(f"Written: {path}")
    return 0


def _compare_study(arguments: argparse.Namespace) -> int:
    from carpus.app.command_line import progress_bar
    from carpus.app.session_commands import read_choices
    from carpus.core.research.agreement.agreement_files import format_limit_verdicts
    from carpus.core.research.agreement.study import format_study, read_study_table, run_study, write_agreement_study

    of_one: dict[str, object] = {"columns": {}, "markers": {}, "unit": None, "session": None}
    given = [name for name, usual in of_one.items() if getattr(arguments, name) != usual]
    if given or math.isfinite(arguments.lag) or arguments.drift:
        return report_usage_error(
            "compare", "in a study the table says session, columns, markers, unit, lag and drift."
        )
    with progress_bar("comparing", "session") as progress:
        lines = read_study_table(arguments.study, parse_mapping)
        study = run_study(
            arguments.study, lines, smoothed=arguments.smoothed, max_shift_s=arguments.max_shift,
            load_choices=read_choices, progress=progress,
        )  # fmt: skip
    known = [one.pairs for one in study.pooled_angles if math.isfinite(one.pairs.figures_deg.bias)]
    for line in [*format_study(study), *format_limit_verdicts(known, arguments.limit)]:
        print(line)
    if arguments.output is not None:
        from carpus.ui.report.agreement_plot import write_plots

        files = write_agreement_study(study, arguments.output, arguments.form)
        picture = replace(study.to_comparison(), pairs=tuple(known))
        if known:
            files += write_plots(picture, arguments.output, arguments.study.stem, arguments.limit)
        for path in files:
            print(f"Written: {path}")
    return 1 if study.excluded else 0
