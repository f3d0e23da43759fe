"""Rows of hands that are not rigid: both protocols, gliding skin, cupping palms, habits, other anatomy.

Kept apart from the rows of rigid hands: nothing was promised of them, and what today's tracker makes of them is told
as it is.
"""

from __future__ import annotations

from typing import Any

from tests.accuracy.hand21 import EXERCISES, TROUBLE, HandScenario
from tests.accuracy.scenarios import USUAL_TROUBLE, Scenario

DRAWN: dict[str, Any] = {"skin_glide_mm": None, "cupping": None}
"""Each seed another person."""
OBLIQUE: dict[str, Any] = {"tilt_deg": 15.0, "tilt_heading_deg": -90.0}
"""The finger tips nearer to the camera than the wrist: there a gliding disc looks most like a flexing wrist."""
_EXERCISE_HZ = (0.25, 0.5)


def _wrist(name: str, **options: Any) -> Scenario:
    return Scenario(name, {**DRAWN, **options}, _EXERCISE_HZ, trouble=dict(USUAL_TROUBLE), pictures=True)


def _hand(name: str, *motions: str, **options: Any) -> HandScenario:
    return HandScenario(name, motions, {**TROUBLE, **DRAWN, **options}, pictures=True)


SOFT_WRIST = (
    _wrist("soft: tenodesis", motion="flexion", habit="tenodesis"),
    _wrist("soft: grip while deviating", motion="deviation", habit="grip", cupping=1.0),
    _wrist("soft: power grip, cupped", motion="power_grip", cupping=1.0),
    _wrist("soft: fingers to 45 and back", motion="bend45"),
    _wrist("soft: fingers to 45 and back, seen obliquely", motion="bend45", **OBLIQUE),
    _wrist("soft: open and close at rest", motion="rest", habit="open_close"),
    _wrist("soft: forearm rolls, restless clicks", motion="mixed", habit="tenodesis+rolling_forearm+restless_clicks"),
    _wrist("soft: other hands", motion="mixed", habit="tenodesis", anatomy="wide"),
    _wrist(
        "soft: other hands, with all they wear",
        motion="flexion",
        habit="tenodesis+restless_clicks",
        anatomy="wide",
        worn="ring+watch+bandage",
        sleeve="jeans",
        pen_marks=6,
    ),
)
SOFT_HAND = (
    _hand("soft: fingers to 45 and back", "bend45"),
    _hand("soft: fingers to 45 and back, seen obliquely", "bend45", **OBLIQUE),
    _hand("soft: power grip, cupped", "power_grip", cupping=1.0),
    _hand("soft: grasping a mug", "grasp_mug"),
    _hand("soft: tenodesis", "flexion", habit="tenodesis"),
    _hand("soft: grip while deviating", "deviation", habit="grip", cupping=1.0),
    _hand("soft: open and close at rest", "rest", habit="open_close"),
    _hand("soft: other disc heights, fingers to 45 and back", "bend45", anatomy="wide", cupping=0.0),
    _hand(
        "soft: other hands",
        *EXERCISES,
        anatomy="wide",
        habit="restless_clicks",
        worn="ring+watch",
        sleeve="jeans",
        pen_marks=6,
    ),
)
