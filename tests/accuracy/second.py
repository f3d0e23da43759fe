"""Rows of the second patient, who is for judging only: nothing is ever chosen on them, and nothing was promised.

Every row is rendered pictures tracked by the whole of Carpus, from folder to session file.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from carpus.core.model.errors import CarpusFault
from carpus.core.model.types import FloatArray
from tests.accuracy import readings
from tests.accuracy.carpus import enough_inside, label_blobs, measure_session, names_taken
from tests.accuracy.hand21 import ANGLES, JOINT_GROUPS, find_seen_joints, readable, with_end_joints
from tests.accuracy.jobs import side_by_side
from tests.accuracy.pages import mark_table
from tests.accuracy.readings import WRIST_COLUMNS, Reading, ReadRow, compute_reading
from tests.accuracy.scores import degrees_between
from tests.second_patient.motions import ROWS, Row, make_motion
from tests.second_patient.recording import Take, cache_recording

SECOND_SEEDS = 9_000_000
"""Seeds of these rows start here, sides in turn."""
LEAST_CLEAR_PX = 3.0
"""Between the edges of two discs of the first picture."""
_MOST_TRIES = 12


@dataclass(frozen=True, slots=True)
class SecondRun:
    """One recording tracked: what a therapist reads live, wrist and joints (None with six discs)."""

    row: str
    wrist: Reading
    joints: Reading | None


def _track_job(job: tuple[Row, int]) -> SecondRun | str:
    """Track one recording of a row and compare it with its truth; what is in the way where that cannot be done."""
    row, seed = job
    try:
        return _track_row(row, seed)
    except CarpusFault as fault:
        return f"second: {row.name}, seed {seed}: not tracked, {type(fault).__name__}: {fault}"


def _track_row(row: Row, seed: int) -> SecondRun:
    folder, truth = cache_recording(row, seed)
    with threadpool_limits(1):
        found = measure_session(folder)
    session = found.session
    pixel = np.array([truth.camera.distort(some) for some in truth.disc_pixel])
    labels = [label_blobs(some, pixel[i], truth.visible_share[i]) for i, some in enumerate(found.blobs)]
    kept = truth.timestamp_s > found.neutral_ends_s
    kept &= enough_inside(pixel[:, list(truth.protocol.palm)], truth.camera)
    names = names_taken(session.markers.measured_px, found.blobs, labels, kept)

    time_s = (truth.timestamp_s - truth.timestamp_s[0])[kept]
    posture = make_motion(row.motion, seed)(time_s)
    moves = np.hstack((posture.wrist, posture.fingers))

    def reading(true: FloatArray, found: FloatArray, sd: FloatArray, where: NDArray[np.bool_] | None = None) -> Reading:
        error, sd_deg = degrees_between(found, true)[kept], np.degrees(sd)[kept]
        error = error if where is None else np.where(where, error, np.nan)
        discs = {"unused": names.missed, "shown": names.shown}
        return compute_reading(time_s, moves, true, kept, error, sd_deg, **discs)

    motion = session.motion
    joints = None
    if truth.protocol.has_fingers:
        angles, sd = with_end_joints(motion.joint_angles_rad), with_end_joints(motion.joint_angles_sd_rad)
        compared = find_seen_joints(names.present) & readable(truth.joint_angles_rad)[kept]
        joints = reading(truth.joint_angles_rad, angles, sd, compared)
    return SecondRun(
        row.name,
        reading(truth.angles_rad, motion.angles_rad, motion.angles_sd_rad),
        joints,
    )


def rows_named(only: str) -> list[Row]:
    """The rows whose name holds ``only``."""
    return [row for row in ROWS if only.lower() in f"second: {row.name}".lower()]


def report(
    rows: Sequence[Row], recordings: int, processes: int, first: int = SECOND_SEEDS
) -> tuple[str, list[ReadRow]]:
    """Run ``recordings`` of each of these rows, seeds from ``first`` on, and tell; also what is read off them."""
    jobs = [(row, _clickable_seed(row, first + 50 * ROWS.index(row) + i)) for row in rows for i in range(recordings)]
    done = side_by_side(_track_job, jobs, processes)
    runs, faults = [run for run in done if isinstance(run, SecondRun)], [run for run in done if isinstance(run, str)]
    read = list(_read_rows(runs, rows))
    return "\n".join([mark_table("second", readings.markdown(read)), *faults]), read


def _clickable_seed(row: Row, seed: int) -> int:
    """The seed, or the next of the same side whose discs stand apart in the first picture: others could not be told
    apart by a click, and a therapist would move the camera nearer."""
    tries = range(seed, seed + 1000 * _MOST_TRIES, 1000)
    return next((one for one in tries if Take(row, one, seconds=0.1).clear_px() >= LEAST_CLEAR_PX), seed)


def _read_rows(runs: Sequence[SecondRun], rows: Sequence[Row]) -> Iterator[ReadRow]:
    groups = {name: tuple(ANGLES.index(one) for one in members) for name, members in JOINT_GROUPS.items()}
    for row in rows:
        mine = [run for run in runs if run.row == row.name]
        if not mine:
            continue
        yield ReadRow(f"second: {row.name}", WRIST_COLUMNS, tuple(run.wrist for run in mine))
        joints = tuple(run.joints for run in mine if run.joints is not None)
        if joints:
            yield ReadRow(f"second: {row.name}, joints", groups, joints)
