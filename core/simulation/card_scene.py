"""The check card with its wedge before the simulator's camera."""

from __future__ import annotations

import math

import cv2
import numpy as np

from carpus.core.check_card.card import (
    CARD_CORNER_MM,
    FOOT_CORNER_MM,
    SLOPE_DEG,
    SLOPE_MM,
    WEDGE_CORNER_MM,
    WIDTH_MM,
    card_sheet,
    wedge_sheet,
)
from carpus.core.simulation.printed_sheets import PX_PER_MM, Placed, texture_of
from carpus.core.types import FloatArray


def card_scene(distance_m: float = 0.6, tilt_deg: float = 4.0, turn_deg: float = 7.0) -> list[Placed]:
    """The flat sheet and both faces of the wedge, nearly straight under the camera."""
    card, wedge = texture_of(card_sheet("a4")), texture_of(wedge_sheet("a4"))
    tilt = np.asarray(cv2.Rodrigues(np.array([math.radians(tilt_deg), 0.0, 0.0]))[0])
    turn = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, math.radians(turn_deg)]))[0])
    # The sheet's x to the right, y down, z into the table: as the camera looks.
    rotation = np.asarray(tilt @ turn, dtype=np.float64)
    a_m = np.array([*CARD_CORNER_MM, 0.0]) / 1e3
    middle_m = a_m + np.array([0.04, 0.07, 0.0])
    shift = np.array([0.01, -0.005, distance_m]) - rotation @ middle_m
    low_edge_m = a_m + np.array([*FOOT_CORNER_MM, 0.0]) / 1e3
    left, top = (round(one * PX_PER_MM) for one in WEDGE_CORNER_MM)
    width, slope = (round(one * PX_PER_MM) for one in (WIDTH_MM, SLOPE_MM))
    faces = [
        (wedge[top : top + slope, left : left + width], SLOPE_DEG, low_edge_m),
        (wedge[top + slope : top + 2 * slope, left : left + width], -SLOPE_DEG, _ridge_m(low_edge_m)),
    ]
    out = [Placed(card, rotation, shift)]
    for texture, rise_deg, corner_m in faces:
        # Up, out of the sheet, is -z here: a face that rises along y turns about x by a negative angle.
        face = np.asarray(cv2.Rodrigues(np.array([-math.radians(rise_deg), 0.0, 0.0]))[0])
        turned = np.asarray(rotation @ face, dtype=np.float64)
        out.append(Placed(np.ascontiguousarray(texture), turned, rotation @ corner_m + shift))
    return out


def _ridge_m(low_edge_m: FloatArray) -> FloatArray:
    slope = math.radians(SLOPE_DEG)
    return low_edge_m + np.array([0.0, SLOPE_MM * math.cos(slope), -SLOPE_MM * math.sin(slope)]) / 1e3
