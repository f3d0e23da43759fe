"""Hands that were calibrated badly, and whether that is said: before the measurement, or by its frames."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Clicks, Verdict
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.errors import CarpusFault
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.pipeline.track import TrackSettings, noise_from_json, track_recording
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from tests.accuracy.carpus import select_scored_frames
from tests.accuracy.jobs import PICTURE_SECONDS
from tests.accuracy.pages import rule_table
from tests.accuracy.scenarios import WRIST
from tests.accuracy.scores import degrees_between
from tests.rendered import read_truth

ROWS = (
    "as it should be",
    "two knuckles swapped",
    "knuckles named one too far",
    "the other hand",
    "clicks beside the discs",
)
_KNUCKLES = np.arange(2, 6)
_BESIDE_PX = 9.0


@dataclass(frozen=True, slots=True)
class BadRun:
    """``told`` kinds of findings before the measurement; errors (N, 3) and stated sds (N, 3) live, degrees, None where
    it could not begin; share of frames that are ``doubtful``, or not tracked."""

    told: tuple[str, ...]
    error_deg: FloatArray | None
    sd_deg: FloatArray | None
    doubtful: float


def clicks_as(row: str, right: Clicks, seed: int) -> Clicks:
    """Clicks of a row, from the right ones."""
    pixel = right.pixel.copy()
    if row == "two knuckles swapped":
        pixel[[3, 4]] = pixel[[4, 3]]
    elif row == "knuckles named one too far":
        pixel[_KNUCKLES] = pixel[np.roll(_KNUCKLES, 1)]
    elif row == "the other hand":
        return replace(right, side="left" if right.side == "right" else "right")
    elif row == "clicks beside the discs":
        pixel += np.random.default_rng(seed).normal(0.0, _BESIDE_PX, pixel.shape)
    return replace(right, pixel=pixel)


def run_one(row: str, seed: int) -> BadRun:
    """Track the rendered mixed exercise of a seed from such clicks."""
    scenario = next(one for one in WRIST if one.name == "mixed axes")
    spec = scenario.spec(seed, PICTURE_SECONDS)
    folder = render_cached(spec)
    truth, verdicts = read_truth(spec, folder), list[Verdict]()
    clicks = clicks_as(row, read_clicks(folder / CLICKS_FILE), seed)
    with tempfile.TemporaryDirectory() as place, threadpool_limits(1):
        output = Path(place) / "session.h5"
        try:
            track_recording(
                TumFolder(folder),
                clicks,
                output,
                TrackSettings(),
                on_verdict=verdicts.append,
            )
        except CarpusFault as fault:
            return BadRun((*_kinds(verdicts), type(fault).__name__), None, None, 1.0)
        session = read_session(output)
    learnt = noise_from_json(session.header.parameters)
    assert learnt is not None
    scored = select_scored_frames(truth, learnt.neutral_ends_s)
    error_deg = degrees_between(session.motion.angles_rad, truth.angles_rad)[scored]
    sd_deg = np.degrees(session.motion.angles_sd_rad)[scored]
    doubtful = float(np.mean(session.status[scored] != TrackStatus.TRACKED))
    return BadRun(_kinds(verdicts), error_deg, sd_deg, doubtful)


def _kinds(verdicts: Sequence[Verdict]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(finding.kind for verdict in verdicts for finding in verdict.findings))


def report(recordings: int) -> str:
    """Run every row and tell, as Markdown."""
    scenario = next(one for one in WRIST if one.name == "mixed axes")
    lines = [
        ["calibrated", "recordings", "told before", "as", "live RMSE", "in 2 sd %", "doubtful, lost or not begun, %"]
    ]
    for row in ROWS:
        runs = [run_one(row, seed) for seed in scenario.seeds(recordings)]
        told = sum(bool(run.told) for run in runs)
        kinds = ", ".join(dict.fromkeys(kind for run in runs for kind in run.told)) or "-"
        begun = [(run.error_deg, run.sd_deg) for run in runs if run.error_deg is not None and run.sd_deg is not None]
        rmse = inside = "-"
        if begun:
            error, sd = (np.concatenate(some) for some in zip(*begun, strict=True))
            rmse = " / ".join(f"{value:.2f}" for value in np.sqrt(np.nanmean(error**2, axis=0)))
            inside = " / ".join(f"{100 * value:.0f}" for value in (np.abs(error) <= 2.0 * sd).mean(axis=0))
        doubtful = 100.0 * float(np.mean([run.doubtful for run in runs]))
        lines.append([row, f"{len(runs)}", f"{told} of {len(runs)}", kinds, rmse, inside, f"{doubtful:.0f}"])
    return rule_table(lines)
