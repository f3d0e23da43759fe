"""What shapes a tracked or calibrated number is a setting, a constant with its reason beside it, or one that is told
here. That what a person may set stands in the shipped file with a sentence is held by the tests of the settings."""

from __future__ import annotations

import ast
from pathlib import Path

from tests.sources import ROOT, SOURCES, parse_file

SHAPING = ("model/hand", "detection", "calibration", "tracking", "tracking/*")
"""Packages of core between the frames and the stored angles; not the folders in them, which measure the camera."""

NO_CHOICE = {
    "what keeps numbers finite, far from any that counts": {
        "model/hand/anatomy_prior": "_FIXED_SD",
        "tracking/filter/joint_limits": "_WIDE",
    },
    "what is asked of a hand and how it is drawn; no angle is made of it": {
        "model/hand/exercises": "AXIS_TICK_DEG STILL_RADIUS_MM",
    },
    "mathematics": {
        "tracking/digits/digit_association": "_LOG_2_PI",
        "tracking/filter/joint_limits": "MID_RANGE_RAD",
    },
    "when a search for a least sum of squares has settled": {
        "calibration/neutral_pose": "_MAX_ITERATIONS _CONVERGED_STEP",
        "model/hand/anatomy_prior": "_MAX_ITERATIONS _COST_TOLERANCE",
    },
    "tables of the clinical reference; how far a hand may be from them lies in settings": {
        "model/hand/anatomy": (
            "_FAN_RAD _FINGER_SHARE _NAIL_SHARE_FINGER _NAIL_SHARE_THUMB _PALM_OFFSET_M _PALM_Y_SHARE _THUMB_ROLL_RAD"
        ),
    },
    "limits and layouts of files and tables": {
        "detection/appearance": "_RANGES",
        "detection/detector": "_SIMILARITY_BINS",
        "detection/blobs": "WEDGES",
        "tracking/filter/settings": "_LIMITS",
    },
    "axes and signs": {
        "calibration/neutral_pose": "TOWARDS_CAMERA",
        "model/hand/anatomy_prior": "_DOWN",
        "tracking/digits/knuckle_flexion": "_DOWN",
        "tracking/association/reacquire": "_MIRROR",
        "tracking/filter/readout": "_DORSAL",
    },
    "a unit: noise is given per sample at 30 Hz": {
        "tracking/filter/motion": "REFERENCE_DT_S",
    },
    "where a number stands among others": {
        "calibration/label_checks": "_THUMB",
        "tracking/filter/palm_state": "N_PALM_DISCS",
    },
    "what is home keeps nothing: any time far below that of a frame": {
        "tracking/filter/soft_tissue": "_AT_ONCE_S",
    },
}
"""Numbers of modules that are no setting, by the reason."""


def shaping_numbers(path: Path) -> set[str]:
    """Names that a module gives to numbers without a reason: any with a point, and whole ones that stand alone."""
    found, body, lines = set(), parse_file(path).body, path.read_text(encoding="utf-8").splitlines()
    for node, beneath in zip(body, [*body[1:], None], strict=True):
        has_comment = "  # " in lines[node.end_lineno - 1] or lines[node.lineno - 2].startswith("# ")
        if has_comment or (isinstance(beneath, ast.Expr) and isinstance(beneath.value, ast.Constant)):
            continue  # its reason
        if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        numbers = [one.value for one in ast.walk(node.value) if isinstance(one, ast.Constant)]
        alone = isinstance(node.value, ast.Constant) and type(node.value.value) is int
        if alone or any(type(number) is float for number in numbers):
            found |= {name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)}
    return found


@SOURCES
def test_constants_that_shape_results_state_their_reason() -> None:
    found = {
        f"{path.relative_to(ROOT / 'core').with_suffix('').as_posix()}.{name}"
        for package in SHAPING
        for path in sorted((ROOT / "core").glob(f"{package}/*.py"))
        for name in shaping_numbers(path)
    }
    names = [f"{module}.{name}" for some in NO_CHOICE.values() for module in some for name in some[module].split()]
    told = set(names)
    assert len(told) == len(names), "each has one reason"
    assert found - told == set(), "say its reason in a comment"
    assert told - found == set(), "gone: take it off the list"
