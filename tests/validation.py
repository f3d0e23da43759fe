"""``make validation``: what Carpus measures of simulated people against the truth and against itself, in one document.

Fresh seeds, which the document names with the versions used, so that a reviewer makes it again. Every value is
simulated: it says what the program does with what it was given, and nothing about skin, glue and people.
"""

from __future__ import annotations

import argparse
import csv
import os
import platform
import secrets
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from importlib.metadata import version
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from carpus import __version__
from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.errors import CalibrationImpossible, CarpusFault
from carpus.core.model.hand.exercises import EXERCISES, Exercise, get_exercise
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import SIMULATED
from carpus.core.pipeline.track import (
    TrackSettings,
    format_parameters,
    noise_from_neutral,
    restart_at_neutral,
    track_recording,
    write_tracked,
)
from carpus.core.platform.provenance import source_revision
from carpus.core.research.agreement.retest import RetestAnalysis, analyse_retests
from carpus.core.research.agreement.study import AgreementStudy, PooledAngle, read_study_table, run_study
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE, sample_clicks, simulate
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import write_truth
from tests.accuracy import readings, second
from tests.accuracy.carpus import measure_still_hand
from tests.accuracy.hand21 import JOINT_GROUPS
from tests.accuracy.pages import rule_table
from tests.simulation.measurements import measurement_sequence

ROOT = Path(__file__).parents[1]
DOCUMENT = ROOT / "resources" / "validation.md"
MOUNTINGS, SECONDS, SPEED_HZ, RENDERED_SECONDS, DISTANCE_M = 2, 8.0, 0.5, 3.5, 0.7
LIBRARIES = ("numpy", "scipy", "opencv-python-headless", "h5py")
GROUPS = {name: joints for name, joints in JOINT_GROUPS.items() if name != "DIP flexion"}


@dataclass(frozen=True, slots=True)
class Job:
    """All recordings of one exercise: two mountings of each person, and of the ``rendered`` people images too."""

    exercise_id: str
    people: int
    rendered: tuple[int, ...]
    first_seed: int

    @property
    def exercise(self) -> Exercise:
        return get_exercise(self.exercise_id)

    def spec(self, person: int, mounting: int) -> RecordingSpec:
        """A person's size, tone, reach and side stay; markers, clicks, light and noise are those of the seed."""
        rng = np.random.default_rng([self.first_seed, person, 31])
        of_exercise = 10_000 * [exercise.id for exercise in EXERCISES].index(self.exercise_id)
        return RecordingSpec(
            seed=self.first_seed + of_exercise + 10 * person + mounting,
            hand=("right", "left")[person % 2],  # type: ignore[arg-type]
            protocol=self.exercise.protocol.name,
            motion=self.exercise.simulated_motion,
            seconds=SECONDS,
            speed_hz=SPEED_HZ if self.exercise.has_repetitions else None,
            hand_length_mm=round(float(rng.uniform(160.0, 205.0))),
            skin_tone=int(rng.integers(0, 6)),
            range_share=round(float(rng.uniform(0.6, 1.0)), 3),
            distance_m=DISTANCE_M,
            skin_glide_mm=None,
            cupping=None,
        )


@dataclass(frozen=True, slots=True)
class Found:
    """The rows that one exercise adds to each table, and what could not be tracked or compared."""

    agreement: tuple[tuple[str, ...], ...]
    joints: tuple[str, ...]
    images: tuple[tuple[str, ...], ...]
    retest: tuple[tuple[str, ...], ...]
    faults: tuple[str, ...]


def write_measured_session(spec: RecordingSpec, exercise: str, subject: str, folder: Path) -> None:
    """Track simulated measurements of the markers, without images, into a session beside its truth."""
    sequence, settings = measurement_sequence(spec), TrackSettings()
    truth = sequence.truth
    hand, neutral_ends_s = measure_still_hand(sequence, CalibrationSettings())
    calibration = hand.calibration
    if calibration is None:
        raise CalibrationImpossible()
    noise = noise_from_neutral(hand.noise, neutral_ends_s, settings.tracker)
    tracker, smooth = settings.build_tracker(calibration, truth.camera, noise)
    header = new_header(
        hand=spec.hand, protocol=spec.marker_protocol, subject_id=subject, exercise=exercise,
        parameters=format_parameters(settings, {SIMULATED: "yes"}, noise), recording_id=str(spec.seed),
    )  # fmt: skip
    times_s, dropped = truth.timestamp_s.tolist(), truth.dropped_before.tolist()
    frames = (
        tracker.step(i, times_s[i], sequence.detections[i], dropped[i])
        for i in restart_at_neutral(range(len(times_s)), tracker, neutral_ends_s, times_s.__getitem__)
    )
    folder.mkdir(parents=True)
    writer = SessionWriter.create(folder / "session.h5", header, truth.camera, calibration)
    write_tracked(writer, frames, smooth, calibration.verdict, None, None, ())
    write_truth(folder / TRUTH_FILE, truth, sample_clicks(truth))


def write_rendered_session(spec: RecordingSpec, exercise: str, subject: str, folder: Path) -> None:
    """Render images and track them, as ``carpus simulate`` and ``carpus track`` do."""
    simulate(spec, folder)
    clicks = read_clicks(folder / CLICKS_FILE)
    track_recording(
        TumFolder(folder), clicks, folder / "session.h5", TrackSettings(), subject_id=subject, exercise=exercise
    )


def compare_all(folder: Path, people: Sequence[tuple[int, Path]]) -> AgreementStudy:
    """Compare each person's sessions with their truth, as ``carpus compare --study`` does."""
    table = folder / "study.csv"
    with table.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(("person", "session", "reference"))
        rows.writerows((f"P{person + 1}", path / "session.h5", path / TRUTH_FILE) for person, path in people)
    return run_study(table, read_study_table(table, lambda _: {}))


def run_exercise(job: Job) -> Found:
    """Simulate, track, compare and retest one exercise."""
    exercise, faults = job.exercise, list[str]()
    made, images = list[tuple[int, Path]](), list[tuple[int, Path]]()
    with tempfile.TemporaryDirectory(prefix="carpus-validation-") as name:
        root = Path(name)
        for person in range(job.people):
            mountings = range(MOUNTINGS if exercise.has_repetitions else 1)
            asked = [(f"{person}-{k}", job.spec(person, k), made, write_measured_session) for k in mountings]
            if person in job.rendered:
                spec = replace(job.spec(person, 0), seconds=RENDERED_SECONDS)
                asked.append((f"{person}-images", spec, images, write_rendered_session))
            for place, spec, into, write in asked:
                try:
                    write(spec, exercise.id, f"P{person + 1}", root / place)
                    into.append((person, root / place))
                except CarpusFault as fault:
                    faults.append(f"{exercise.id}, person {person + 1}, seed {spec.seed}: {fault}")
        study = compare_all(root, made)
        faults += [f"{exercise.id}, {line.person}: {why}" for line, why in study.excluded]
        results = [compute_session_results(read_session(path / "session.h5")) for _, path in made]
        retests = tuple(analyse_retests(results)) if exercise.has_repetitions else ()
        reasons = Counter(left.reason.replace("_", " ") for one in retests for left in one.excluded)
        faults += [f"{exercise.id}, retest: {reason}, {count} recordings" for reason, count in reasons.items()]
        rendered = compare_all(root, images) if images else None
    angles = {pooled.pairs.name: pooled for pooled in study.pooled_angles}
    told = WRIST_ANGLES if not exercise.digits else tuple(name for name in angles if name == exercise.joint)
    return Found(
        tuple(_agreement_row(exercise, angles[name]) for name in told),
        _joints_row(exercise, study) if exercise.digits else (),
        () if rendered is None else (_images_row(exercise, study, rendered),),
        tuple(_retest_rows(exercise, retests)),
        tuple(faults),
    )


def _agreement_row(exercise: Exercise, pooled: PooledAngle) -> tuple[str, ...]:
    f = pooled.pairs.figures_deg
    return (
        exercise.id, pooled.pairs.name, f"{pooled.variance.people}", f"{pooled.session_count}",
        f"{f.bias:+.2f} ({f.bias_interval[0]:+.2f} to {f.bias_interval[1]:+.2f})",
        f"{f.limits[0]:+.2f} to {f.limits[1]:+.2f}", f"{f.rmse:.2f}", f"{f.correlation:.3f}",
        f"{pooled.variance.sd_between:.2f}", f"{pooled.variance.sd_within:.2f}",
    )  # fmt: skip


def _rmse_deg(study: AgreementStudy, names: Sequence[str]) -> str:
    """Format the root-mean-square difference of some angles over all frames, NaN without any."""
    pairs = [one.pairs for one in study.pooled_angles if one.pairs.name in names]
    if not pairs:
        return "–"
    off = np.degrees(np.concatenate([one.measured_rad - one.reference_rad for one in pairs]))
    return f"{np.sqrt(np.mean(off**2)):.2f}"


def _joints_row(exercise: Exercise, study: AgreementStudy) -> tuple[str, ...]:
    return (exercise.id, *(_rmse_deg(study, names) for names in ((name,) for name in WRIST_ANGLES)),
            *(_rmse_deg(study, names) for names in GROUPS.values()))  # fmt: skip


def _images_row(exercise: Exercise, study: AgreementStudy, rendered: AgreementStudy) -> tuple[str, ...]:
    columns = [WRIST_ANGLES, GROUPS["MCP flexion"], GROUPS["PIP flexion"]]
    both = [f"{_rmse_deg(rendered, names)} / {_rmse_deg(study, names)}" for names in columns]
    return (exercise.id, f"{len(rendered.comparisons)}", both[0], *(both[1:] if exercise.digits else ("–", "–")))


def _retest_rows(exercise: Exercise, retests: Sequence[RetestAnalysis]) -> Iterator[tuple[str, ...]]:
    """Yield the trained angle's movements; of a joint's also."""
    trained = exercise.joint or WRIST_ANGLES[exercise.angle or 0]
    for one in retests:
        for (of, movement), f in one.results.items():
            if of == trained:
                low, high = f.mdc95_interval
                yield (
                    exercise.id, f"{of}, {movement}", f"{f.people}", f"{f.sem:.2f}",
                    f"{f.mdc95:.1f} ({low:.1f} to {high:.1f})", f"{f.icc:.3f}", f"{f.icc_3_1:.3f}",
                    f"{f.systematic_change:+.2f}",
                )  # fmt: skip


def write_document(options: argparse.Namespace, found: Sequence[Found], judged: str) -> str:
    """Lay out all tables."""
    asked = f"--first-seed {options.first_seed} --people {options.people} --exercises {','.join(options.exercises)}"
    libraries = ", ".join(f"{name} {version(name)}" for name in LIBRARIES)
    faults = [f"- {fault}" for one in found for fault in one.faults] or ["- nothing"]

    def table(columns: str, name: str) -> str:
        rows = [row for one in found for row in getattr(one, name)]
        return rule_table([columns.split(" | "), *rows]) if rows else "None was asked for."

    joints = [one.joints for one in found if one.joints]
    joint_columns = ("exercise", *WRIST_ANGLES, *GROUPS)
    agreement = table(
        "exercise | angle | people | sessions | bias (95 % interval) | limits of agreement | RMSE | r "
        "| SD between people | SD within a person", "agreement",
    )  # fmt: skip
    retest = table(
        "exercise | measure | people | SEM | MDC95 (95 % interval) | ICC(2,1) | ICC(3,1) | second minus first", "retest"
    )
    return f"""# Validation on simulated people

**Everything on this page is simulated: simulated hands in front of a simulated camera.** It says what the program
makes of what it is given. It says nothing about real skin, glue, light and people: see
[what has not been tried](untried.md). One command made this page, and nothing on it was written by hand.

| | |
|---|---|
| make it again | `make validation ARGUMENTS='{asked}'` |
| Carpus | {__version__}, revision {source_revision()[:12] or "unknown"} |
| with | Python {platform.python_version()}, {libraries}; {platform.system()} {platform.machine()} |
| seeds | from {options.first_seed} on, drawn for this run; settings were chosen on others ([accuracy](accuracy.md)) |
| people | {options.people}, with {MOUNTINGS} mountings of the markers for each exercise that has repetitions |

Hand length (160 to 205 mm), side, skin tone and reach (60 to 100 % of the full range) are a person's own. Markers,
clicks, light and noise are drawn again for each mounting. So are the proportions of the bones, which real people keep.
Hands are soft: skin slides over the knuckles, and the palm cups.

## Agreement with the simulated truth

Each recording lasts {SECONDS:g} s, with {SPEED_HZ:g} repetitions a second. It has no images, but what the detector
finds in them; its errors were fitted to rendered images. The table compares the live estimate of the trained angle or
joint with the truth, in degrees (Carpus minus truth), in all frames in which the hand is tracked. The truth has no
error of its own and the same clock. Limits of agreement: Bland and Altman (2007).

{agreement}

Root-mean-square difference in degrees with 21 markers, joints that are occluded included:

{rule_table([joint_columns, *joints]) if joints else "None was asked for."}

## The same from images

{RENDERED_SECONDS:g} s of rendered colour and depth images of one person for each exercise, tracked by the whole
program. Root-mean-square difference in degrees, from images / without images (all people, as above).

{table("exercise | people | wrist | MCP flexion | PIP flexion", "images")}

## Test and retest

The same people measured twice. SEM: standard error of measurement. MDC95: minimal detectable change, with its 95 %
interval. Both in degrees. Free movements have no repetitions. A range that ends out of the camera's sight is left out.
An ICC is low where the simulated people hardly differ, as in the extension of their fingers.

{retest}

## Second patient

Another simulated anatomy with other skin and its own movements, on which no setting was ever chosen. Rendered images,
one person a recording, errors of the live angles in degrees, as in
[the notes on accuracy](research-notes/accuracy.md).

{judged or "Not asked for."}

## Not tracked, not compared, or left out of the retest

{chr(10).join(faults)}
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run all exercises and write the document."""
    known = [exercise.id for exercise in EXERCISES]
    parser = argparse.ArgumentParser(prog="python -m tests.validation", description=__doc__)
    parser.add_argument("--first-seed", type=int, help="drawn unless given")
    parser.add_argument("--people", type=int, default=20)
    parser.add_argument("--exercises", default=",".join(known), type=lambda text: text.split(","))
    parser.add_argument("--second", type=int, default=1, help="recordings of each row of the second patient; 0: none")
    parser.add_argument("--images", action=argparse.BooleanOptionalAction, default=True, help="render some of them")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--output", type=Path, default=DOCUMENT)
    options = parser.parse_args(arguments)
    if not set(options.exercises) <= set(known):
        parser.error(f"exercises are {', '.join(known)}")
    if options.first_seed is None:
        options.first_seed = 10_000_000 + secrets.randbelow(1_000_000_000)
    begin = time.monotonic()
    jobs = [
        Job(
            name,
            options.people,
            (k % options.people,) if options.images else (),
            options.first_seed,
        )
        for k, name in enumerate(options.exercises)
    ]
    with ProcessPoolExecutor(options.processes, mp_context=get_context("spawn")) as pool:
        futures = [pool.submit(run_exercise, job) for job in jobs]
        found = []
        for job, future in zip(jobs, futures, strict=True):
            found.append(future.result())
            print(f"{job.exercise_id}: {time.monotonic() - begin:.0f} s", file=sys.stderr, flush=True)
    judged = ""
    if options.second:
        _, read = second.report(second.rows_named(""), options.second, options.processes, options.first_seed + 900_000)
        judged = readings.markdown(read)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(write_document(options, found, judged), encoding="utf-8")
    print(f"{options.output}, {(time.monotonic() - begin) / 60:.0f} minutes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
