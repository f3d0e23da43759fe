"""The check card before right cameras of each kind of sensor, for a real check's 30 seconds, and before cameras whose
depth is 2 % off: how often a right one is called out, and a wrong one told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.calibration.card.card import CHECK_S, CardReading
from carpus.core.calibration.card.measure import SEARCH_INTERVAL_S, measure_card
from carpus.core.model.depth_sensor import SENSORS
from tests.accuracy.cameras import OFF_SHARE, most_of
from tests.accuracy.pages import ruled
from tests.studio import LENS, Studio, card_scene

SEED = 7600
FEWER = 10
"""Of the wrong cameras' pictures one in so many is looked at: it is their scale that tells."""
SENSORS_SHOWN = {"structured light": "primesense", "active stereo, D435": "d435", "time of flight": "azure"}
MANY = 5
"""Times as many checks with few pictures: what stays of the error counts, and more pictures do not change it."""
ROWS = (
    *((f"card: {name}", sensor, 1) for name, sensor in SENSORS_SHOWN.items()),
    *((f"card, one picture in {FEWER}: {name}", sensor, FEWER) for name, sensor in SENSORS_SHOWN.items()),
)


@dataclass(frozen=True, slots=True)
class CardRun:
    """One check of a right camera, and whether it was told with depth 2 % too long and too short."""

    right: CardReading
    told: tuple[bool, bool]


def run_one(sensor: str, seed: int, step: int) -> CardRun:
    """Lay the card somewhere before a right camera of a kind of sensor and look at it for 30 seconds, at every picture
    or at one in so many."""
    camera = replace(LENS, sensor=SENSORS[sensor])
    studio = Studio(camera, seed, depth_scale_error=0.0)
    rng = np.random.default_rng([seed, 1])
    scene = card_scene(float(rng.uniform(0.55, 0.65)), float(rng.uniform(0.0, 8.0)), float(rng.uniform(-20.0, 20.0)))
    seen = [
        studio.frame(scene, k, SEARCH_INTERVAL_S * k) for k in range(0, round(CHECK_S / SEARCH_INTERVAL_S) + 1, step)
    ]
    right = measure_card(seen, camera, sensor)
    fewer = seen[:: FEWER // step]
    longer, shorter = (
        measure_card([replace(one, depth_unit_m=one.depth_unit_m * share) for one in fewer], camera, sensor)
        for share in (1.0 + OFF_SHARE, 1.0 - OFF_SHARE)
    )
    return CardRun(right, (not longer.has_valid_lengths, not shorter.has_valid_lengths))


HEAD = (
    "sensor", "checks of a right camera", "limits, ° / mm", "angles off, °", "lengths off, mm", "all lengths off, %",
    "called out", f"{100 * OFF_SHARE:.0f} % off told",
)  # fmt: skip


def report(only: str, seeds: int) -> str:
    """Run every sensor with fresh seeds and tell."""
    rows = [HEAD]
    for number, (name, sensor, step) in enumerate(ROWS):
        if only.lower() in name.lower():
            count = seeds if step == 1 else MANY * seeds
            rows.append(_row(name, [run_one(sensor, SEED + 100 * number + k, step) for k in range(count)]))
    return ruled(rows) if rows[1:] else ""


def _row(name: str, runs: Sequence[CardRun]) -> tuple[str, ...]:
    right = [run.right for run in runs]
    limits = np.mean([(one.max_angle_error_deg, one.max_length_error_mm) for one in right], axis=0)
    out = sum(not (one.has_valid_angles and one.has_valid_lengths) for one in right)
    return (
        name, str(len(runs)), f"{limits[0]:.1f} / {limits[1]:.1f}",
        most_of([one.angle_error_deg for one in right], 1), most_of([one.length_error_mm for one in right], 1),
        most_of([100.0 * abs(one.scale - 1.0) for one in right], 2), f"{out} of {len(runs)}",
        f"{sum(map(sum, (run.told for run in runs)))} of {2 * len(runs)}",
    )  # fmt: skip
