"""The named rows of the accuracy table: who moves how, under which troubles."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from carpus.core.simulation.spec import RecordingSpec

REPORT_SEEDS = 500_000
"""Seeds of the table start here. Settings are chosen on others, so that the table stays a test."""

USUAL_TROUBLE: dict[str, Any] = {"false_blobs": 2.0, "hidden_share": 0.1, "dropped_share": 0.01}
SLOW = "exercises and reaching"
FAST = "1.7 Hz deviation"
REACHING = "reaching"
_EXERCISE_HZ = (0.25, 0.5)


@dataclass(frozen=True, slots=True)
class Scenario:
    """One row.

    ``options`` and ``trouble`` go to every :class:`RecordingSpec`; ``speeds_hz`` is the range from which each seed
    draws its repetitions a second; ``columns`` names the column of each angle compared (several may share one);
    ``pool`` is the pooled row that it counts in; ``times_seeds`` recordings for every seed asked for; ``pictures``:
    also by rendered pictures, where what they show matters.
    """

    name: str
    options: dict[str, Any]
    speeds_hz: tuple[float, float] | None = None
    columns: tuple[str, ...] = ("deviation", "flexion", "pro/sup")
    pool: str | None = None
    times_seeds: int = 1
    pictures: bool = False
    trouble: dict[str, Any] = field(default_factory=lambda: dict(USUAL_TROUBLE))

    def spec(self, seed: int, seconds: float) -> RecordingSpec:
        """The recording of a seed: side by parity, all else (size, tone, light, place) drawn by it."""
        rng = np.random.default_rng([seed, 77])
        speed = None if self.speeds_hz is None else round(float(rng.uniform(*self.speeds_hz)), 3)
        usual = {"seed": seed, "seconds": seconds, "hand": "left" if seed % 2 else "right", "speed_hz": speed}
        return RecordingSpec(**{**usual, **self.trouble, **self.options})

    def seeds(self, count: int) -> list[int]:
        """Seeds of this row alone, the same ones whatever other rows there are."""
        own = sum(ord(letter) * 31**i for i, letter in enumerate(self.name)) % 4000
        return [REPORT_SEEDS + 100 * own + i for i in range(count * self.times_seeds)]


WRIST = (
    Scenario("rest", {"motion": "rest"}, pictures=True),
    Scenario("flexion ±50°", {"motion": "flexion"}, _EXERCISE_HZ, pool=SLOW, pictures=True),
    Scenario("deviation ±25°", {"motion": "deviation"}, _EXERCISE_HZ, pool=SLOW, pictures=True),
    Scenario("pro/supination ±35°", {"motion": "pronosupination"}, _EXERCISE_HZ, pool=SLOW, pictures=True),
    Scenario("mixed axes", {"motion": "mixed"}, _EXERCISE_HZ, pool=SLOW, pictures=True),
    Scenario(REACHING, {"motion": "reach"}, pool=SLOW, pictures=True),
    Scenario("deviation 1.7 Hz", {"motion": "fast_deviation"}, pool=FAST, times_seeds=3, pictures=True),
)
"""The rows of the wrist, every one with two false blobs a frame, one marker in ten hidden, one frame in 100 lost."""


def _add_trouble(name: str, *, pictures: bool = False, **changes: Any) -> Scenario:
    options = {"motion": "mixed", **{key: value for key, value in changes.items() if key not in USUAL_TROUBLE}}
    trouble = {**USUAL_TROUBLE, **{key: value for key, value in changes.items() if key in USUAL_TROUBLE}}
    return Scenario(name, options, _EXERCISE_HZ, trouble=trouble, pictures=pictures)


TROUBLE = (
    _add_trouble("no false blobs", false_blobs=0.0),
    _add_trouble("3 false blobs", false_blobs=3.0),
    _add_trouble("10 false blobs", false_blobs=10.0),
    _add_trouble("nothing hidden", hidden_share=0.0),
    _add_trouble("30 % hidden", hidden_share=0.3),
    _add_trouble("object passes", object_passes=True, pictures=True),
    _add_trouble("leaves and returns", leaves_picture=True, pictures=True),
    _add_trouble("dim", light="dim", pictures=True),
    _add_trouble("dark skin", skin_tone=5, pictures=True),
    _add_trouble("child", hand_length_mm=135.0, pictures=True),
    _add_trouble("left hand", hand="left"),
    _add_trouble("clicks off by 5 px", click_error_px=5.0),
    _add_trouble("depth scale 2 %", depth_scale_error=0.02),
    _add_trouble("15 frames a second", fps=15.0),
    _add_trouble("10 % dropped", dropped_share=0.1),
    _add_trouble("blue sleeve", sleeve="blue", pictures=True),
)
"""The mixed exercise of the wrist under one trouble more, or less, at a time."""

GROUPS: dict[str, tuple[Scenario, ...]] = {"wrist": WRIST, "trouble": TROUBLE}
