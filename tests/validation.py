"""``make validation``: one document with every table of accuracy, agreement with the simulated truth and retest, from
fresh seeds, which it names with the versions used, so that a reviewer makes it again.

Every figure is synthetic: simulated hands before a simulated camera. It says what the program does with what it was
given, and nothing about skin, glue and people.
"""

from __future__ import annotations

import argparse
import csv
import os
import platform
import secrets
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from carpus import __version__
from carpus.app.batch.tracking_task import TrackingTask
from carpus.app.batch.worker_pool import run_tasks
from carpus.app.sources import TrackingInput
from carpus.core.pipeline.track import TrackSettings
from carpus.core.platform.provenance import source_revision
from carpus.core.research.agreement.retest import RetestAnalysis, analyse_retests
from carpus.core.research.agreement.study import AgreementStudy, format_study, read_study_table, run_study
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE, simulate
from carpus.core.simulation.spec import RecordingSpec
from carpus.ui.report.agreement_plot import write_plots
from tests.accuracy import hand21_table, readings_table
from tests.accuracy.__main__ import HAND_ROWS, WRIST_ROWS
from tests.accuracy.jobs import all_runs, jobs_for
from tests.accuracy.table import markdown, read_rows, rows_of
from tests.accuracy.targets import verdicts

ROOT = Path(__file__).parents[1]
DOCUMENT = ROOT / "resources" / "validation.md"
MOTIONS = {"flexion": "WRIST_FE", "deviation": "WRIST_RU", "pronosupination": "FOREARM_PS"}
SECONDS, SPEED_HZ, MOUNTINGS, DISTANCE_M = 8.0, 0.5, 2, 0.7
LIBRARIES = ("numpy", "scipy", "opencv-python-headless", "h5py")


@dataclass(frozen=True)
class Mounting:
    """One recording: a person's size, tone and reach, discs put on and clicked anew."""

    person: int
    number: int
    spec: RecordingSpec

    @property
    def name(self) -> str:
        return f"person{self.person + 1}-mounting{self.number + 1}"


def mountings(motion: str, people: int, first_seed: int) -> list[Mounting]:
    """Of each person some, by seeds that nothing else has."""
    out = []
    for person in range(people):
        rng = np.random.default_rng([first_seed, person, 31])
        own = {
            "hand_length_mm": round(float(rng.uniform(160.0, 205.0))), "skin_tone": int(rng.integers(0, 6)),
            "range_share": round(float(rng.uniform(0.6, 1.0)), 3), "hand": ("right", "left")[person % 2],
        }  # fmt: skip
        for number in range(MOUNTINGS):
            seed = first_seed + 5_000_000 + 10_000 * (1 + list(MOTIONS).index(motion)) + 10 * person + number
            spec = RecordingSpec(
                seed=seed, motion=motion, seconds=SECONDS, speed_hz=SPEED_HZ, distance_m=DISTANCE_M, **own  # type: ignore[arg-type]
            )  # fmt: skip
            out.append(Mounting(person, number, spec))
    return out


def _rendered(job: tuple[RecordingSpec, Path]) -> None:
    simulate(*job)


def tracked(made: Sequence[Mounting], exercise: str, folder: Path, processes: int) -> AgreementStudy:
    """Render and track all, as ``carpus track`` does many recordings, and hold them against their truth."""
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        list(pool.map(_rendered, [(one.spec, folder / one.name) for one in made]))
    tasks = []
    for one in made:
        recording, session = folder / one.name, folder / f"{one.name}.h5"
        place = TrackingInput(recording, recording / CLICKS_FILE, session, session.name)
        tasks.append(TrackingTask(place, TrackSettings(), f"P{one.person + 1}", exercise))
    faults = [each.messages for each in run_tasks(tasks, processes) if each.result == "fault"]
    if faults:
        print(f"{len(faults)} not tracked: {faults[0]}", file=sys.stderr)
    table = folder / f"{made[0].spec.motion}.csv"
    with table.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(("person", "session", "reference"))
        rows.writerows((f"P{one.person + 1}", f"{one.name}.h5", f"{one.name}/{TRUTH_FILE}") for one in made)
    return run_study(table, read_study_table(table, lambda _: {}))


def retested(made: Sequence[Mounting], folder: Path) -> list[RetestAnalysis]:
    """Test and retest of the mountings that were tracked."""
    paths = [path for one in made if (path := folder / f"{one.name}.h5").exists()]
    return analyse_retests([compute_session_results(read_session(path)) for path in paths])


def accuracy(only: str, seeds: int, first_seed: int, processes: int) -> Iterator[str]:
    """The tables of ``make accuracy`` from other seeds, by measurements (no rendered pictures)."""
    names = [name for name in WRIST_ROWS if name != "sensors"]
    wrist = [row for name in names for row in WRIST_ROWS[name] if only in row.name]
    hand = [row for name in ("hand", "soft") for row in HAND_ROWS[name] if only in row.name]
    if wrist:
        runs = all_runs(jobs_for(wrist, seeds, 0, first_seed), processes)
        rows = list(rows_of(runs, wrist))
        promised = {row.name for name, some in WRIST_ROWS.items() if name not in ("soft", "sensors") for row in some}
        own = [row for row in wrist if row.name in promised]
        kept = [run for run in runs if run.scenario in promised]
        yield from ("### Wrist, six discs", "", markdown(rows), "", "What is read off:", "")
        yield from (readings_table.markdown(read_rows(rows)), "")
        if kept and not only:
            yield from ("What was promised:", "", *(f"- {verdict}" for verdict in verdicts(kept, own)), "")
    if hand:
        jobs = hand21_table.hand_jobs(hand, seeds, 0, first_seed + 1_000_000)
        runs_of_hands = hand21_table.all_hand_runs(jobs, processes)
        yield from ("### Whole hand, 21 discs", "", hand21_table.markdown(runs_of_hands, hand), "")


def retest_lines(found: Sequence[RetestAnalysis]) -> Iterator[str]:
    yield "| exercise | of | people | SEM | MDC95 (95 % interval) | ICC(2,1) | ICC(3,1) | last less first |"
    yield "|---|---|---|---|---|---|---|---|"
    for one in found:
        for (of, movement), f in one.results.items():
            low, high = f.mdc95_interval
            yield (
                f"| {one.exercise} | {of} {movement} | {f.people} | {f.sem:.2f} "
                f"| {f.mdc95:.1f} ({low:.1f} to {high:.1f}) | {f.icc:.3f} | {f.icc_3_1:.3f} | {f.systematic_change:+.2f} |"  # noqa: E501
            )
        for left in one.excluded:
            yield f"| {one.exercise} | left out: {left.reason.replace('_', ' ')} | | | | | | |"


def head(options: argparse.Namespace) -> Iterator[str]:
    asked = f"--first-seed {options.first_seed} --seeds {options.seeds} --people {options.people}"
    asked += f" --motions {','.join(options.motions)}" + (f' --only "{options.only}"' if options.only else "")
    libraries = ", ".join(f"{name} {version(name)}" for name in LIBRARIES)
    yield f"""# Validation

Made by one command; nothing in it was written by hand. **All of it is synthetic: simulated hands before a simulated
camera.** It says what the program makes of what it is given, and nothing about skin, glue, light and people; see
[what has not been tried](untried.md).

| | |
|---|---|
| again | `make validation ARGUMENTS='{asked}'` |
| Carpus | {__version__}, revision {source_revision()[:12] or "unknown"} |
| with | Python {platform.python_version()}, {libraries}; {platform.system()} {platform.machine()} |
| seeds | from {options.first_seed} on, drawn for this run; settings were chosen on others ([accuracy](accuracy.md)) |
| accuracy | {options.seeds} recordings a row |
| agreement, retest | {options.people} people, {MOUNTINGS} mountings each |

Few recordings scatter: a figure here stands beside that of [accuracy](accuracy.md), which rests on more.
"""


def agreement_part(options: argparse.Namespace) -> Iterator[str]:
    """Agreement with the truth and retest, with a picture for each motion beside the document."""
    yield f"""## Agreement with the simulated truth

Rendered pictures, {SECONDS:g} s each at {SPEED_HZ:g} repetitions a second, tracked as `carpus track` does, live
estimate; degrees, Carpus less truth. The truth stands in for a reference system on the same clock, without error of its
own. Limits by Bland and Altman (2007), intervals by Zou (2013).
"""
    found: list[RetestAnalysis] = []
    for motion in options.motions:
        made = mountings(motion, options.people, options.first_seed)
        with tempfile.TemporaryDirectory(prefix="carpus-validation-") as name:
            folder = Path(name)
            study = tracked(made, MOTIONS[motion], folder, options.processes)
            found += retested(made, folder)
            yield from (f"### {motion}", "", "```", *format_study(study), "```", "")
            pictures = options.output.parent / "pictures"
            for one in study.pooled_angles:
                if one.pairs.name == motion and np.isfinite(one.pairs.figures_deg.bias):
                    write_plots(study.to_comparison(), folder / "plots", motion)
                    pictures.mkdir(parents=True, exist_ok=True)
                    shutil.copy(folder / "plots" / f"{motion}.{motion}.png", pictures / f"validation-{motion}.png")
                    yield from (f"![Carpus and truth, {motion}](pictures/validation-{motion}.png)", "")
    yield """## Retest

The same people measured twice: size, tone and reach stay; discs, clicks, light and noise are drawn anew, and so are the
proportions of the bones, which real people keep. Degrees.
"""
    yield from (*retest_lines(found), "")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.validation", description=__doc__)
    parser.add_argument("--first-seed", type=int, help="drawn unless given")
    parser.add_argument("--seeds", type=int, default=3, help="recordings a row of accuracy")
    parser.add_argument("--people", type=int, default=6, help="for agreement and retest; 0 for none")
    parser.add_argument("--motions", default=",".join(MOTIONS), type=lambda text: text.split(","))
    parser.add_argument("--only", default="", metavar="TEXT", help="rows whose name holds this")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--output", type=Path, default=DOCUMENT)
    options = parser.parse_args(arguments)
    if not set(options.motions) <= set(MOTIONS):
        parser.error(f"motions are {', '.join(MOTIONS)}")
    if options.first_seed is None:
        options.first_seed = 10_000_000 + secrets.randbelow(1_000_000_000)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    lines = list(head(options))
    if options.people:
        lines += agreement_part(options)
    lines += ["## Accuracy", "", *accuracy(options.only, options.seeds, options.first_seed, options.processes)]
    options.output.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print(options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
