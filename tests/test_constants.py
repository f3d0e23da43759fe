"""What shapes a tracked or calibrated number lies in settings, which go into the session; what may not is told here."""

from __future__ import annotations

import ast
from pathlib import Path

ROOT = Path(__file__).parents[1]
SHAPING = ("tracking",)
"""Packages of core between the pictures and the stored angles."""

NO_CHOICE = {
    "what keeps numbers finite, far from any that counts": {
        "tracking/anatomy_refinement._NARROW_RAD",
        "tracking/association.IMPOSSIBLE",
        "tracking/finger_model._NARROW2",
        "tracking/joint_limits._WIDE",
        "tracking/kernel._LEAST_PROBABILITY",
        "tracking/palm_state._HARDLY_M",
        "tracking/palm_view._FLOOR",
        "tracking/ray_filter._FLOOR",
        "tracking/reacquire._LOOSE_M2",
        "tracking/shape_learning._FLOOR_M",
        "tracking/tracker._NEAREST_M",
        "tracking/tracker._NO_NOISE",
    },
    "mathematics": {
        "tracking/finger_naming._LOG_2_PI",
        "tracking/joint_limits._ROOT_2_OVER_PI",
        "tracking/joint_limits._ROOT_HALF",
        "tracking/joint_limits.RANGE_SD_RAD",  # of an even spread over the limits
        "tracking/joint_limits.MID_RANGE_RAD",
    },
    "axes and signs": {
        "tracking/finger_depth._DOWN",
        "tracking/finger_naming._BENDS",
        "tracking/hand_geometry._DOWN",
        "tracking/hand_geometry._FINGER_PHASES",
        "tracking/hand_geometry._FINGER_TURNS",
        "tracking/hand_geometry._THUMB_PHASES",
        "tracking/hand_geometry._TO_DIP",
        "tracking/hand_geometry._TURNS",
        "tracking/reacquire._MIRROR",
        "tracking/readout._DORSAL",
    },
    "a unit: noise is told per sample at 30 Hz": {"tracking/motion.REFERENCE_DT_S"},
    "where a number stands among others": {
        "tracking/finger_depth.FLEXION",
        "tracking/hand_geometry.DISCS",
        "tracking/palm_state.PALM_DISCS",
        "tracking/ray_filter._ROLL",
    },
    "half of a picture's weight now and half right after": {"tracking/disc_anew._TWICE"},
}
"""Numbers of modules that are no setting, by the reason."""


def shaping_numbers(path: Path) -> set[str]:
    """Names that a module gives to numbers: any with a point, and whole ones that stand alone."""
    found = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        numbers = [one.value for one in ast.walk(node.value) if isinstance(one, ast.Constant)]
        alone = isinstance(node.value, ast.Constant) and type(node.value.value) is int
        if alone or any(type(number) is float for number in numbers):
            found |= {name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)}
    return found


def test_what_shapes_a_number_lies_in_settings() -> None:
    found = {
        f"{path.relative_to(ROOT / 'core').with_suffix('').as_posix()}.{name}"
        for package in SHAPING
        for path in sorted((ROOT / "core" / package).rglob("*.py"))
        for name in shaping_numbers(path)
    }
    told = set().union(*NO_CHOICE.values())
    assert len(told) == sum(map(len, NO_CHOICE.values())), "each has one reason"
    assert found - told == set(), "put it into the settings beside it, or tell why it is none"
    assert told - found == set(), "gone: take it off the list"
