"""``python -m tests.accuracy``: the errors of Carpus against simulated truth, beside the simplest thing.

Every figure is synthetic: simulated hands, simulated camera. Printed as Markdown, which
``python -m tests.accuracy.pages FILE`` puts into the pages.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeVar

from carpus.core.platform.provenance import source_revision
from tests.accuracy import badly, hand21, readings, second
from tests.accuracy.hand21 import ROWS, HandRun, HandScenario
from tests.accuracy.jobs import all_runs, make_jobs
from tests.accuracy.pages import mark_table, rule_table
from tests.accuracy.readings import ReadRow
from tests.accuracy.scenarios import GROUPS, Scenario
from tests.accuracy.scores import Run, collect_rows, markdown, read_rows
from tests.accuracy.soft import SOFT_HAND, SOFT_WRIST

_Row = TypeVar("_Row", Scenario, HandScenario)

SEEDS = 3
WRIST_ROWS: Mapping[str, tuple[Scenario, ...]] = {**GROUPS, "soft": SOFT_WRIST}
HAND_ROWS: Mapping[str, tuple[HandScenario, ...]] = {"hand": ROWS, "soft": SOFT_HAND}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.accuracy", description=__doc__)
    parser.add_argument(
        "--group",
        choices=("all", *dict.fromkeys((*WRIST_ROWS, *HAND_ROWS)), "second", "badly"),
        default="all",
        help="which rows; second: the patient that is for judging only, by rendered pictures alone; "
        "badly: hands calibrated badly",
    )
    parser.add_argument("--only", default="", metavar="TEXT", help="rows whose name holds this")
    parser.add_argument(
        "--seeds",
        type=int,
        default=SEEDS,
        help="simulated recordings of a row that is not rendered (the fast row takes three times)",
    )
    parser.add_argument("--pictures", type=int, default=1, help="rendered recordings a row; 0: simulated ones of all")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args(arguments)
    seeds, pictures = options.seeds, options.pictures
    wrist, hand = (_named(rows, options.group, options.only) for rows in (WRIST_ROWS, HAND_ROWS))
    judged = second.rows_named(options.only) if options.group in ("all", "second") and pictures else []
    if not wrist and not hand and not judged and options.group != "badly":
        print(f"no row of {options.group} is named like {options.only}", file=sys.stderr)
        return 2
    begin = time.monotonic()
    read: list[ReadRow] = []
    if wrist:
        told, some = _wrist_report(wrist, seeds, pictures, options.processes)
        read += some
        print(told, flush=True)
    if hand:
        hands = hand21.run_hands(hand, seeds, pictures, options.processes)
        read += hand21.read_rows(hands, hand)
        print("", *_hand_tables(hands, hand), sep="\n", flush=True)
    if options.group in ("all", "badly") and pictures and not options.only:
        print("", mark_table("badly", badly.report(pictures)), sep="\n", flush=True)
    if judged:
        told, some = second.report(judged, pictures, options.processes)
        read += some
        print("", told, sep="\n")
    if options.group == "all" and pictures and not options.only:
        for name, rows in _patient_tables(read):
            print("", mark_table(name, rule_table(rows)), sep="\n")
        print("", mark_table("made", _made(seeds, pictures)), sep="\n")
    print(f"{time.monotonic() - begin:.0f} s", file=sys.stderr)
    return 0


def _named(rows: Mapping[str, tuple[_Row, ...]], group: str, only: str) -> list[_Row]:
    """The rows of a group, or of all, whose name holds ``only``."""
    groups = [some for name, some in rows.items() if group in ("all", name)]
    return [row for some in groups for row in some if only.lower() in row.name.lower()]


def _wrist_report(
    scenarios: Sequence[Scenario], seeds: int, pictures: int, processes: int
) -> tuple[str, list[ReadRow]]:
    """Run these rows and tell; also what is read off them."""
    runs = all_runs(make_jobs(scenarios, seeds, pictures), processes)
    told = "\n".join(_wrist_tables(runs, scenarios))
    return told, read_rows(list(collect_rows(runs, scenarios)))


def _wrist_tables(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> Iterator[str]:
    """The two tables of every group of rows."""
    for group, every in WRIST_ROWS.items():
        some = [row for row in scenarios if row in every]
        if rows := list(collect_rows(runs, some)):
            yield from (mark_table(group, markdown(rows)), "")
            yield from (mark_table(f"{group} read", readings.markdown(read_rows(rows))), "")


def _hand_tables(runs: Sequence[HandRun], scenarios: Sequence[HandScenario]) -> Iterator[str]:
    """The same of the whole hand."""
    for group, every in HAND_ROWS.items():
        name = "hand" if group == "hand" else f"{group} hand"
        some = [row for row in scenarios if row in every]
        if some:
            yield from (mark_table(name, hand21.markdown(runs, some)), "")
            yield from (mark_table(f"{name} read", readings.markdown(hand21.read_rows(runs, some))), "")


def _made(seeds: int, pictures: int) -> str:
    """Where the tables of a run of all come from."""
    return (
        f"The tables below were made by one run of revision {source_revision()[:12] or 'unknown'}: {pictures} of every row\n"  # noqa: E501
        f"that is rendered, {seeds} or more of every row of simulated measurements."
    )


def _patient_tables(read: Sequence[ReadRow]) -> Iterator[tuple[str, list[tuple[str, ...]]]]:
    """The tables of both patients, and the README's: the second patient's wrist."""

    def of(*names: str) -> list[ReadRow]:
        return [row for row in read if row.name in names]

    def first(*groups: Sequence[Scenario]) -> list[ReadRow]:
        return of(*(f"{row.name} (pictures)" for group in groups for row in group))

    def hands(group: Sequence[HandScenario]) -> list[ReadRow]:
        return of(*(f"21 discs, {row.name} (pictures): {part}" for row in group for part in ("wrist", "joints")))

    def judged(protocol: str, *, rigid: bool) -> list[ReadRow]:
        rows = [row.name for row in second.ROWS if row.protocol == protocol and row.rigid is rigid]
        return of(*(f"second: {name}{part}" for name in rows for part in ("", ", joints")))

    yield (
        "first patient",
        readings.patient_rows(
            [
                ("rigid, 6 markers: exercises, reaching, fast", first(WRIST_ROWS["wrist"])),
                ("rigid, 6 markers: in trouble", first(WRIST_ROWS["trouble"])),
                ("rigid, 21 markers", hands(HAND_ROWS["hand"])),
                ("soft, 6 markers", first(SOFT_WRIST)),
                ("soft, 21 markers", hands(SOFT_HAND)),
            ]
        ),
    )
    rows = readings.patient_rows(
        [
            ("rigid, 6 markers", judged("wrist6", rigid=True)),
            ("soft, 6 markers", judged("wrist6", rigid=False)),
            ("rigid, 21 markers", judged("hand21", rigid=True)),
            ("soft, 21 markers", judged("hand21", rigid=False)),
        ]
    )
    yield "second patient", rows
    yield "readme", [row[:5] for row in rows]


if __name__ == "__main__":
    sys.exit(main())
