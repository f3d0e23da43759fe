"""What shapes a tracked or calibrated number lies in settings, which go into the session; what may not is told here."""

from __future__ import annotations

import ast
from pathlib import Path

from tests.sources import ROOT, SOURCES, parsed

SHAPING = ("hand", "detection", "calibration", "tracking")
"""Packages of core between the pictures and the stored angles; not the folders in them, which measure the camera."""

NO_CHOICE = {
    "what keeps numbers finite, far from any that counts": {
        "calibration/clicks": "_NO_PIXEL_PX",
        "detection/blobs": "_BEYOND_M",
        "detection/detector": "_NEAREST_M",
        "hand/anatomy_prior": "_FIXED",
        "hand/back_surface": "_NOWHERE",
        "tracking/association": "IMPOSSIBLE",
        "tracking/digit_filter": "FLOOR",
        "tracking/digit_readout": "_NARROW2",
        "tracking/finger_model": "_NARROW_RAD",
        "tracking/hand_filter": "_NEAREST_M",
        "tracking/joint_limits": "_WIDE",
        "tracking/kernel": "_LEAST_PROBABILITY",
        "tracking/palm_state": "FLOOR _HARDLY_M",
        "tracking/predicted_measurement": "_FLOOR_M",
        "tracking/reacquire": "_LOOSE_M2",
        "tracking/surface_fit": "_NO_NOISE",
    },
    "what is asked of a hand and how it is drawn; no angle is made of it": {
        "hand/exercises": "AXIS_LIMIT_DEG AXIS_TICK_DEG EXERCISES STILL_RADIUS_MM",
    },
    "mathematics": {
        "tracking/digit_association": "_LOG_2_PI",
        "tracking/joint_limits": "MID_RANGE_RAD RANGE_SD_RAD _ROOT_2_OVER_PI _ROOT_HALF",  # the first of an even spread
    },
    "when a search for a least sum of squares has settled": {
        "calibration/neutral_pose": "_ROUNDS _SETTLED",
        "hand/anatomy_prior": "_DIFFERENCE_STEP _MOST_STEPS _SETTLED",
    },
    "tables of the clinical reference; how far a hand may be from them lies in settings": {
        "calibration/calibrate": "_MCP3_OVER_HAND_LENGTH",
        "hand/anatomy": (
            "ABDUCTION_LIMIT_RAD BREADTH_SHARE HARD_LIMITS_RAD REFERENCE_LENGTH_M _ARCH_M _FAN_RAD "
            "_FINGER_OFFSET_M _FINGER_SHARE _NAIL_SHARE_FINGER _NAIL_SHARE_THUMB _PALM_OFFSET_M _PALM_X_SHARE "
            "_PALM_Y_SHARE _THUMB_OFFSET_M _THUMB_ROLL_RAD _THUMB_SHARE"
        ),
        "hand/kinematics": "DIP_PER_PIP",
    },
    "which of three clinical angles are defined at all, by the clinical reference": {
        "hand/clinical_angles": "ZYZ_MOST_SD_RAD ZYZ_UNDEFINED_BELOW_RAD",
    },
    "limits and layouts of files and tables": {
        "calibration/clicks": "_MOST_BYTES",
        "detection/appearance": "BINS _RANGES",
        "detection/detector": "_SIMILARITY_BINS",
        "detection/stencil": "WEDGES",
        "hand/back_surface": "TABLE_ROWS",
        "tracking/settings": "_LIMITS",
    },
    "axes and signs": {
        "calibration/calibrate": "_TOWARDS_CAMERA",
        "hand/anatomy_prior": "_DOWN",
        "tracking/digit_association": "BENDS",
        "tracking/finger_depth": "_DOWN",
        "tracking/hand_geometry": "_DOWN _FINGER_PHASES _FINGER_TURNS _THUMB_PHASES _TO_DIP _TURNS",
        "tracking/reacquire": "_MIRROR",
        "tracking/readout": "_DORSAL",
    },
    "a unit: noise is told per sample at 30 Hz": {
        "tracking/motion": "REFERENCE_DT_S",
    },
    "where a number stands among others": {
        "calibration/name_checks": "_THUMB",
        "calibration/still_depth": "_CORNERS",
        "tracking/digit_filter": "_ROLL",
        "tracking/finger_depth": "FLEXION",
        "tracking/hand_geometry": "DISCS",
        "tracking/palm_state": "PALM_DISCS",
    },
    "about the line of sight depths tell nothing: a rank, which no figure hangs on": {
        "tracking/readout": "_TILT_KNOWN",
    },
    "what is home keeps nothing: any time far below a frame's": {
        "tracking/soft_tissue": "_AT_ONCE_S",
    },
    "half of a picture's weight now and half right after": {
        "tracking/hand_filter": "_TWICE",
    },
}
"""Numbers of modules that are no setting, by the reason."""


def shaping_numbers(path: Path) -> set[str]:
    """Names that a module gives to numbers: any with a point, and whole ones that stand alone."""
    found = set()
    for node in parsed(path).body:
        if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        numbers = [one.value for one in ast.walk(node.value) if isinstance(one, ast.Constant)]
        alone = isinstance(node.value, ast.Constant) and type(node.value.value) is int
        if alone or any(type(number) is float for number in numbers):
            found |= {name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)}
    return found


@SOURCES
def test_what_shapes_a_number_lies_in_settings() -> None:
    found = {
        f"{path.relative_to(ROOT / 'core').with_suffix('').as_posix()}.{name}"
        for package in SHAPING
        for path in sorted((ROOT / "core" / package).glob("*.py"))
        for name in shaping_numbers(path)
    }
    names = [f"{module}.{name}" for some in NO_CHOICE.values() for module in some for name in some[module].split()]
    told = set(names)
    assert len(told) == len(names), "each has one reason"
    assert found - told == set(), "put it into the settings beside it, or tell why it is none"
    assert told - found == set(), "gone: take it off the list"
