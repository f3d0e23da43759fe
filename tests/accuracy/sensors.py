"""Rows of the depth sensors: the same people and exercises before each kind, wrist and whole hand.

Their hands are not rigid (:mod:`.soft`): what a sensor is worth shows on people. The Xtion's rows are what the others
are held against; of all it is wanted that the truth lies within two stated standard deviations in 88 to 98 % of frames.
"""

from __future__ import annotations

from carpus.core.depth_sensor import SENSORS
from tests.accuracy.hand21 import EXERCISES, TROUBLE, HandScenario
from tests.accuracy.scenarios import USUAL_TROUBLE, Scenario
from tests.accuracy.soft import DRAWN

RENDERED = ("d435", "azure")
"""One of each new kind also by pictures; the Xtion's are those of the other rows."""
SENSOR_WRIST = tuple(
    Scenario(
        f"sensor: {sensor.name}",
        {**DRAWN, "motion": "mixed", "sensor": name},
        (0.25, 0.5),
        trouble=dict(USUAL_TROUBLE),
        has_bound=False,
        pictures=name in RENDERED,
    )
    for name, sensor in SENSORS.items()
)
SENSOR_HAND = tuple(
    HandScenario(
        f"sensor: {sensor.name}", EXERCISES, {**TROUBLE, **DRAWN, "sensor": name}, weight=2, pictures=name in RENDERED
    )
    for name, sensor in SENSORS.items()
)
