"""What the screen of the board is told, as values, and what it says: what to do next, the result line by line."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.calibration.camera.board import BOARDS, MOST_EDGE_PX, Board, Pattern
from carpus.core.calibration.camera.calibrate import FAIR_PX, GOOD_PX, MOST_APART_PX, CameraCalibration, DepthCheck
from carpus.core.calibration.camera.effect import FLEXION_DEG, HAND_LENGTH_M, Effect
from carpus.core.calibration.camera.sheet import RULER_MM, Paper
from carpus.core.calibration.camera.views import (
    FEWEST_FIELDS,
    FEWEST_SIDES,
    FIELDS,
    LEAST_TILT_DEG,
    MOST_MOTION_PX,
    SIDES,
    GuidanceStep,
    Judgement,
    Lack,
    Look,
    Side,
)
from carpus.core.types import FloatArray, Frame
from carpus.ui import numbers
from carpus.ui.icons import State
from carpus.ui.translate import tr

Row = tuple[State, str, str, str]
"""State, thing, value, and limit or words."""
_FOCAL_SHARE, _MIDDLE_PX, _DEPTH_SHARE = 0.003, 2.0, 0.003
"""Changes below these are none worth a word."""
MOST_FLAT_MM = 3.0


def side_name(side: Side) -> str:
    """As a person holds the board."""
    return {"left": tr("left edge"), "right": tr("right edge"), "top": tr("upper edge"), "bottom": tr("lower edge")}[
        side
    ]


def place_name(field: tuple[int, int]) -> str:
    """Where in the picture a field lies."""
    down, across = field
    up, low = down == 0, down == FIELDS[1] - 1
    left, right = across < FIELDS[0] / 3, across >= 2 * FIELDS[0] / 3
    if left or right:
        corner = {
            (True, True): tr("top left"), (True, False): tr("top right"),
        } if up else {
            (True, True): tr("bottom left"), (True, False): tr("bottom right"),
        } if low else {(True, True): tr("left"), (True, False): tr("right")}  # fmt: skip
        return corner[True, left]
    return tr("top") if up else tr("bottom") if low else tr("centre")


def step_words(step: GuidanceStep) -> tuple[str, str]:
    """The instruction, and how."""
    if step.kind == "place" and step.field is not None:
        what = tr("Move the board to the {place}").format(place=place_name(step.field))
        if step.side is None:
            return what, tr("Into the dashed outline, then hold still.")
        how = tr("Into the dashed outline, its {side} nearer to the camera; then hold still.")
        return what, how.format(side=side_name(step.side))
    if step.kind == "tilt" and step.side is not None:
        what = tr("Tilt the board: {side} nearer").format(side=side_name(step.side))
        return what, tr("Nearly half-way to upright, then hold still.")
    if step.kind == "near":
        return tr("Bring the board nearer"), tr("About 45 cm from the camera, then hold still.")
    if step.kind == "far":
        return tr("Take the board farther away"), tr("About 85 cm from the camera, then hold still.")
    return tr("That is enough"), tr("Press “Work out”, or show more: it only gets better.")


def lack_words(lack: Lack) -> str:
    """What this picture lacks; empty where it lacks nothing."""
    return {
        "": "",
        "dark": tr("More light: the picture is too dark."),
        "no_board": tr("No board seen: show all of it, flat, in even light."),
        "too_tilted": tr("Turn it less: it is nearly edge-on."),
        "moving": tr("Hold still."),
        "blurred": tr("Not sharp: hold still, or give it more light."),
        "known": tr("Taken. Now another place."),
    }[lack]


def check_rows(now: BoardProgress) -> list[Row]:
    """How far each thing is."""
    judged, look = now.judgement, now.look
    missing = [side for side in SIDES if side not in judged.sides]
    enough = len(judged.sides) >= FEWEST_SIDES
    all_sides = tr("all four sides")
    tilts = all_sides if not missing else tr("{side} missing").format(side=side_name(missing[0]))
    if enough and missing:
        tilts = tr("{count} sides").format(count=len(judged.sides))
    near, far = judged.nearest_m, judged.farthest_m
    away = numbers.UNKNOWN
    if math.isfinite(near):
        away = tr("{near}–{far} cm").format(near=f"{100 * near:.0f}", far=f"{100 * far:.0f}")
    sharp = look.edge_px <= MOST_EDGE_PX
    still = not look.motion_px > MOST_MOTION_PX
    return [
        (
            "good" if judged.fields >= FEWEST_FIELDS else "partly", tr("Places"),
            tr("{count} fields").format(count=judged.fields),
            tr("{least} of {all} or more").format(least=FEWEST_FIELDS, all=FIELDS[0] * FIELDS[1]),
        ),
        (
            "good" if enough else "partly", tr("Tilts"), tilts,
            tr("{least} sides, over {tilt}°").format(least=FEWEST_SIDES, tilt=f"{LEAST_TILT_DEG:.0f}"),
        ),
        ("good" if judged.is_near_and_far else "partly", tr("Distance"), away, tr("near and far")),
        (
            "good" if sharp else "open" if math.isnan(look.edge_px) else "warn", tr("Sharpness"),
            numbers.UNKNOWN if math.isnan(look.edge_px) else tr("sharp") if sharp else tr("not sharp"),
            tr("edges below {most} px").format(most=f"{MOST_EDGE_PX:.0f}"),
        ),
        (
            "open" if look.found is None else "good" if still else "warn", tr("Still"),
            numbers.UNKNOWN if look.found is None else tr("still") if still else tr("moving"),
            tr("below {most} px/picture").format(most=f"{MOST_MOTION_PX:.0f}"),
        ),
    ]  # fmt: skip


def to_go_words(now: BoardProgress | None) -> str:
    """The primary button: what it does, or what it waits for."""
    if now is None:
        return tr("Work out · show the board")
    left = now.asked - now.judgement.views
    if left > 0:
        one = tr("Work out · 1 picture to go") if left == 1 else tr("Work out · {count} pictures to go")
        return one.format(count=left)
    return tr("Work out · more places and tilts") if now.judgement.missing else tr("Work out")


# --- the result -------------------------------------------------------------------------------------------
def headline(result: BoardResult) -> tuple[str, str]:
    """The sentence, and what it means."""
    made, effect = result.made, result.effect
    error = made.intrinsics.error_px
    if error > FAIR_PX:
        return (
            tr("Not good enough: lines land {error} px off.").format(error=numbers.fixed(error, 1)),
            tr("Nothing is changed. Glue the board onto something flat and stiff, give it light, and take the pictures "
               "again."),
        )  # fmt: skip
    if made.depth is not None and not made.depth.is_registered:
        apart = numbers.fixed(float(np.hypot(*made.depth.apart_px)), 1)
        return (
            tr("Depth lies {apart} px beside the colours.").format(apart=apart),
            tr("Nothing is changed. Switch the camera’s registration on: run “carpus doctor”, it says how."),
        )
    land = tr("Lines land within {error} pixels of where they are.").format(error=numbers.fixed(error, 2))
    return tr("The camera is calibrated. {depth}").format(depth=depth_words(made.depth)), tr(
        "{land} A hand of {hand} mm read {more} before; it is put right from now on."
    ).format(land=land, hand=f"{1e3 * HAND_LENGTH_M:.0f}", more=_more_mm(effect.length_more_mm))


def depth_words(depth: DepthCheck | None) -> str:
    """How far depth was off."""
    if depth is None:
        return tr("Its depth was not checked.")
    share, shift = 100.0 * (depth.scale - 1.0), 1e3 * depth.offset_m
    if abs(share) < 0.05 and abs(shift) < 0.5:
        return tr("Depth reads right.")
    pattern = tr("Depth read {share} % too long.") if share > 0 else tr("Depth read {share} % too short.")
    return pattern.format(share=numbers.fixed(abs(share), 1))


def _more_mm(value_mm: float) -> str:
    if abs(value_mm) < 0.05:
        return tr("right")
    pattern = tr("{size} mm too long") if value_mm > 0 else tr("{size} mm too short")
    return pattern.format(size=numbers.fixed(abs(value_mm), 1))


def result_rows(result: BoardResult) -> list[tuple[State, str, str, str, str]]:
    """State, what, before, now, in words."""
    made, effect = result.made, result.effect
    now, before, depth = made.intrinsics.camera, made.before, made.depth
    error = made.intrinsics.error_px
    land = (
        tr("good: below {limit} px").format(limit=GOOD_PX) if error <= GOOD_PX
        else tr("fair: below {limit} px").format(limit=FAIR_PX) if error <= FAIR_PX
        else tr("poor: above {limit} px").format(limit=FAIR_PX)
    )  # fmt: skip
    focal = 0.5 * (now.fx_px / before.fx_px + now.fy_px / before.fy_px) - 1.0
    away = math.hypot(now.cx_px - before.cx_px, now.cy_px - before.cy_px)
    rows: list[tuple[State, str, str, str, str]] = [
        ("good" if error <= FAIR_PX else "bad", tr("Lines land within"), f"{numbers.fixed(effect.before_px, 2)} px",
         f"{numbers.fixed(error, 2)} px", land),
        ("good", tr("Focal length"), f"{numbers.fixed(before.fx_px, 1)} px",
         f"{numbers.fixed(now.fx_px, 1)} ± {numbers.fixed(made.intrinsics.focal_sd_px, 1)} px",
         tr("{share} % off before").format(share=numbers.fixed(100 * abs(focal), 1)) if abs(focal) >= _FOCAL_SHARE
         else tr("as before")),
        ("good", tr("Middle of the picture"), f"{numbers.fixed(before.cx_px, 1)}, {numbers.fixed(before.cy_px, 1)}",
         f"{numbers.fixed(now.cx_px, 1)}, {numbers.fixed(now.cy_px, 1)}",
         tr("{away} px to the side").format(away=f"{away:.0f}") if away >= _MIDDLE_PX else tr("as before")),
        ("good", tr("Lens bends lines by"), tr("not known") if not before.is_distorted else tr("known"),
         tr("{bend} px at most").format(bend=numbers.fixed(effect.bend_px, 1)), tr("put right")),
    ]  # fmt: skip
    unknown = tr("not known")
    if depth is None:
        rows.append(("warn", tr("Depth"), unknown, numbers.UNKNOWN, tr("too few pictures with depth on the board")))
        return rows
    share, shift = 100.0 * (depth.scale - 1.0), 1e3 * depth.offset_m
    sure = math.isfinite(depth.offset_sd_m)
    apart = float(np.hypot(*depth.apart_px))
    rows += [
        ("good", tr("Depth scale"), unknown, f"{numbers.signed(share, 2)} ± {numbers.fixed(100 * depth.scale_sd, 2)} %",
         tr("put right") if abs(share) >= 100 * _DEPTH_SHARE else tr("small; put right")),
        ("good", tr("Depth shift"), unknown,
         f"{numbers.signed(shift, 1)} ± {numbers.fixed(1e3 * depth.offset_sd_m, 1)} mm" if sure else tr("none sure"),
         tr("put right") if sure else tr("within the scale’s error")),
        ("good" if 1e3 * depth.flat_m <= MOST_FLAT_MM else "warn", tr("Board flat in depth"), "",
         f"{numbers.fixed(1e3 * depth.flat_m, 1)} mm", tr("good: within {most} mm").format(most=f"{MOST_FLAT_MM:.0f}")
         if 1e3 * depth.flat_m <= MOST_FLAT_MM else tr("noisy: keep 50 to 80 cm")),
        ("good" if depth.is_registered else "bad", tr("Colour on depth"), unknown,
         tr("{apart} px apart").format(apart=numbers.fixed(apart, 1)),
         tr("good: below {most} px").format(most=f"{MOST_APART_PX:.0f}") if depth.is_registered
         else tr("registration is off")),
    ]  # fmt: skip
    thin = int(np.count_nonzero(made.judgement.corners_in_field == 0))
    if thin:
        words = tr("1 field empty") if thin == 1 else tr("{count} fields empty")
        rows.append(("warn", tr("Edge of the picture"), "", words.format(count=thin), tr("keep the hand inside")))
    return rows


def effect_rows(result: BoardResult) -> list[tuple[str, str]]:
    """What the old values did to a hand."""
    effect = result.effect
    angle = tr("{size}° less") if effect.angle_more_deg < 0 else tr("{size}° more")
    return [
        (
            tr("Wrist flexion of {angle}°, read before").format(angle=f"{FLEXION_DEG:.0f}"),
            angle.format(size=numbers.fixed(abs(effect.angle_more_deg), 1)),
        ),
        (
            tr("Hand of {length} mm, read before").format(length=f"{1e3 * HAND_LENGTH_M:.0f}"),
            _more_mm(effect.length_more_mm),
        ),
    ]


def kept_words(result: BoardResult) -> str:
    """Where it will be kept, and what of sessions before."""
    if result.simulated:
        return tr("A simulated camera: kept apart, for practice with the check card; no real session uses it.")
    if not result.serial:
        return tr(
            "This camera does not say its number, so nothing can be kept for it. “carpus calibrate-camera --output” "
            "writes a camera file that the settings can name."
        )
    before = tr("the one of {day}").format(day=result.since) if result.since else tr("the maker’s values")
    return tr(
        "Kept for this camera, number {serial}, instead of {before}. Sessions measured before keep their values and "
        "say so."
    ).format(serial=result.serial, before=before)


@dataclass(frozen=True, slots=True)
class BoardChoice:
    """Which board on which paper, how long its ruler was measured, and whether before the simulated camera."""

    pattern: Pattern = "chessboard"
    paper: Paper = "a4"
    ruler_mm: float = RULER_MM
    practice: bool = False

    @property
    def board(self) -> Board:
        board, share = BOARDS[self.pattern], self.ruler_mm / RULER_MM
        return replace(board, square_m=board.square_m * share, code_m=board.code_m * share)


@dataclass(frozen=True, slots=True)
class BoardProgress:
    """How far the showing of the board is: the newest ``look``, all that was kept, the next ``step``, and where the
    board is wanted (4, 2) in the picture, None for nowhere in particular; ``asked`` so many pictures. ``frame`` is the
    one that was looked at: its corners are drawn on it and on no other."""

    look: Look
    judgement: Judgement
    step: GuidanceStep
    target: FloatArray | None
    corner_count: int
    asked: int
    frame: Frame


@dataclass(frozen=True, slots=True)
class BoardResult:
    """A calibration before it is kept. ``camera`` and ``serial`` name it, ``serial`` empty where nobody knows which it
    is; ``since`` the day of the calibration used so far, empty for the maker's own values."""

    made: CameraCalibration
    effect: Effect
    camera: str
    serial: str
    since: str = ""
    simulated: bool = False
    may_use: bool = True
