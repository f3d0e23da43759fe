"""What mends a doubtful calibration: the cause decides what the primary button does. Nothing here wipes all names."""

from __future__ import annotations

from typing import Literal

from carpus.core.calibration.result import Verdict
from carpus.ui.controls.button import ENTER
from carpus.ui.translate import tr

Remedy = Literal["swap", "click_these", "correct", "take_spot", "new_picture"]

_PICTURE = ("tilt", "distance", "moved", "few_frames", "depth_off")
"""Causes that lie with hand, camera or light, never with the names."""


def remedy_of(verdict: Verdict, *, is_live: bool) -> Remedy:
    """The likeliest way out, that of wrong names before that of a bad picture."""
    kinds = {finding.kind for finding in verdict.findings}
    if "swapped" in kinds:
        return "swap"
    if "shifted" in kinds or any(finding.blocks and finding.markers for finding in verdict.findings):
        return "click_these"
    if kinds & {"wrong_side", "misnamed"}:
        return "correct"
    if "other_spot" in kinds:
        return "take_spot"
    if kinds & {"no_palm", "near_spot"}:
        return "click_these"
    if is_live and kinds & set(_PICTURE):
        return "new_picture"
    if kinds & {"residual", "no_depth"}:
        return "click_these"
    return "correct"


def exchanged(verdict: Verdict) -> list[tuple[str, str]]:
    """Names that stand in for each other: two, or those of two fingers each for each."""
    names = next((finding.markers for finding in verdict.findings if finding.kind == "swapped"), ())
    half = len(names) // 2
    return list(zip(names[:half], names[half:], strict=True))


def at_fault(verdict: Verdict) -> tuple[str, ...]:
    """The markers that something is found with."""
    return tuple(dict.fromkeys(name for finding in verdict.findings for name in finding.markers))


def face(remedy: Remedy) -> tuple[str, str]:
    """Words and key of the primary button."""
    return {
        "swap": (tr("Swap the two"), ENTER),
        "click_these": (tr("Click again"), "C"),
        "correct": (tr("Correct names"), ""),
        "take_spot": (tr("Take that spot"), ""),
        "new_picture": (tr("New picture"), "N"),
    }[remedy]
