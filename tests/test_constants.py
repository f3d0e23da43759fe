"""What shapes a tracked or calibrated number lies in settings, which go into the session; what may not is told here."""

from __future__ import annotations

import ast
from pathlib import Path

from tests.sources import ROOT, SOURCES, parsed

SHAPING = ("hand", "detection", "calibration", "tracking")
"""Packages of core between the pictures and the stored angles; not the folders in them, which measure the camera."""

NO_CHOICE = {
    "what keeps numbers finite, far from any that counts": {
        "calibration/clicks._NO_PIXEL_PX",
        "detection/blobs._BEYOND_M",
        "hand/anatomy_prior._FIXED",
        "hand/back_surface._NOWHERE",
        "tracking/finger_model._NARROW_RAD",
        "tracking/association.IMPOSSIBLE",
        "tracking/digit_readout._NARROW2",
        "tracking/joint_limits._WIDE",
        "tracking/kernel._LEAST_PROBABILITY",
        "tracking/palm_state._HARDLY_M",
        "tracking/palm_state.FLOOR",
        "tracking/digit_filter.FLOOR",
        "tracking/reacquire._LOOSE_M2",
        "tracking/predicted_measurement._FLOOR_M",
        "tracking/hand_filter._NEAREST_M",
        "detection/detector._NEAREST_M",
        "tracking/surface_fit._NO_NOISE",
    },
    "what is asked of a hand and how it is drawn; no angle is made of it": {
        "hand/exercises.AXIS_LIMIT_DEG",
        "hand/exercises.AXIS_TICK_DEG",
        "hand/exercises.EXERCISES",
        "hand/exercises.STILL_RADIUS_MM",
    },
    "mathematics": {
        "tracking/digit_association._LOG_2_PI",
        "tracking/joint_limits._ROOT_2_OVER_PI",
        "tracking/joint_limits._ROOT_HALF",
        "tracking/joint_limits.RANGE_SD_RAD",  # of an even spread over the limits
        "tracking/joint_limits.MID_RANGE_RAD",
    },
    "when a search for a least sum of squares has settled": {
        "calibration/neutral_pose._ROUNDS",
        "calibration/neutral_pose._SETTLED",
        "hand/anatomy_prior._DIFFERENCE_STEP",
        "hand/anatomy_prior._MOST_STEPS",
        "hand/anatomy_prior._SETTLED",
    },
    "tables of the clinical reference; how far a hand may be from them lies in settings": {
        "calibration/calibrate._MCP3_OVER_HAND_LENGTH",
        "hand/anatomy.ABDUCTION_LIMIT_RAD",
        "hand/anatomy.BREADTH_SHARE",
        "hand/anatomy.HARD_LIMITS_RAD",
        "hand/anatomy.REFERENCE_LENGTH_M",
        "hand/anatomy._ARCH_M",
        "hand/anatomy._FAN_RAD",
        "hand/anatomy._FINGER_OFFSET_M",
        "hand/anatomy._FINGER_SHARE",
        "hand/anatomy._NAIL_SHARE_FINGER",
        "hand/anatomy._NAIL_SHARE_THUMB",
        "hand/anatomy._PALM_OFFSET_M",
        "hand/anatomy._PALM_X_SHARE",
        "hand/anatomy._PALM_Y_SHARE",
        "hand/anatomy._THUMB_OFFSET_M",
        "hand/anatomy._THUMB_ROLL_RAD",
        "hand/anatomy._THUMB_SHARE",
        "hand/kinematics.DIP_PER_PIP",
    },
    "which of three clinical angles are defined at all, by the clinical reference": {
        "hand/clinical_angles.ZYZ_MOST_SD_RAD",
        "hand/clinical_angles.ZYZ_UNDEFINED_BELOW_RAD",
    },
    "limits and layouts of files and tables": {
        "calibration/clicks._MOST_BYTES",
        "detection/appearance.BINS",
        "detection/appearance._RANGES",
        "detection/detector._SIMILARITY_BINS",
        "detection/stencil.WEDGES",
        "hand/back_surface.TABLE_ROWS",
        "tracking/settings._LIMITS",
    },
    "axes and signs": {
        "calibration/calibrate._TOWARDS_CAMERA",
        "hand/anatomy_prior._DOWN",
        "tracking/finger_depth._DOWN",
        "tracking/digit_association.BENDS",
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
        "calibration/still_depth._CORNERS",
        "calibration/name_checks._THUMB",
        "tracking/finger_depth.FLEXION",
        "tracking/hand_geometry.DISCS",
        "tracking/palm_state.PALM_DISCS",
        "tracking/digit_filter._ROLL",
    },
    "about the line of sight depths tell nothing: a rank, which no figure hangs on": {"tracking/readout._TILT_KNOWN"},
    "what is home keeps nothing: any time far below a frame's": {"tracking/soft_tissue._AT_ONCE_S"},
    "half of a picture's weight now and half right after": {"tracking/hand_filter._TWICE"},
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
    told = set().union(*NO_CHOICE.values())
    assert len(told) == sum(map(len, NO_CHOICE.values())), "each has one reason"
    assert found - told == set(), "put it into the settings beside it, or tell why it is none"
    assert told - found == set(), "gone: take it off the list"
