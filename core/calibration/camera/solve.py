"""From pictures of the board to how the camera sees: Zhang's method, as OpenCV has it, with its standard deviations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.calibration.camera.views import BoardView, judge
from carpus.core.camera import Camera
from carpus.core.errors import BoardMissing, BoardUnfit, BoardViewsAlike
from carpus.core.phrase import phrase
from carpus.core.types import FloatArray

GOOD_PX, FAIR_PX, MOST_PX = 0.3, 0.6, 1.2
"""Root mean square distance of a corner from where the calibration has it."""
MOST_FOCAL_SD = 0.002
"""Of the focal length: with more the views were too alike, whatever else they were."""
_OUTLIER = 3.0
_FEWEST_AFTER = 10


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """``camera`` as found; standard deviations of focal lengths and of the middle of the picture; ``error_px`` root
    mean square over all corners; the pose of the board in each view, as rotation vectors and shifts (V, 3);
    ``used`` the numbers of the views that count."""

    camera: Camera
    focal_sd_px: float
    middle_sd_px: float
    error_px: float
    board_turn: FloatArray
    board_shift_m: FloatArray
    used: tuple[int, ...]

    @property
    def error_in_words(self) -> str:
        """How good the fit is."""
        for limit, words in ((GOOD_PX, "good"), (FAIR_PX, "fair")):
            if self.error_px <= limit:
                return f"{words}: below {limit:g} px"
        return f"poor: above {FAIR_PX:g} px"


def solve_intrinsics(views: Sequence[BoardView], width_px: int, height_px: int, subject: str) -> Intrinsics:
    """Intrinsics and distortion (k1, k2, p1, p2) from the views.

    Raises :class:`BoardMissing` where no board was seen, :class:`BoardViewsAlike` where the views are too few or too
    alike, :class:`BoardUnfit` where the corners are not those of a flat board.
    """
    if not views:
        raise BoardMissing(subject, phrase("in none of the pictures"))
    used = list(range(len(views)))
    _require(views, width_px, height_px, subject)
    fit = _fitted([views[k] for k in used], width_px, height_px)
    # A picture that was blurred or bent the board counts no more.
    limit = _OUTLIER * float(np.median(fit.view_error_px))
    kept = [k for k, error in zip(used, fit.view_error_px, strict=True) if error <= limit]
    if _FEWEST_AFTER <= len(kept) < len(used):
        used = kept
        fit = _fitted([views[k] for k in used], width_px, height_px)
    if fit.error_px > MOST_PX or not math.isfinite(fit.error_px):
        raise BoardUnfit(
            subject,
            phrase(
                "corners lie {error_px} px off, at most {most_px} are fair",
                error_px=f"{fit.error_px:.1f}",
                most_px=f"{MOST_PX:g}",
            ),
        )
    if fit.focal_sd_px > MOST_FOCAL_SD * fit.camera.fx_px:
        share = 100.0 * fit.focal_sd_px / fit.camera.fx_px
        raise BoardViewsAlike(subject, phrase("the focal length is known to {share} % only", share=f"{share:.1f}"))
    return Intrinsics(fit.camera, fit.focal_sd_px, fit.middle_sd_px, fit.error_px, fit.turn, fit.shift_m, tuple(used))


def _require(views: Sequence[BoardView], width_px: int, height_px: int, subject: str) -> None:
    missing = judge(views, width_px, height_px).missing
    if missing:
        raise BoardViewsAlike(subject, missing)


@dataclass(frozen=True, slots=True)
class _Fit:
    camera: Camera
    focal_sd_px: float
    middle_sd_px: float
    error_px: float
    view_error_px: FloatArray
    turn: FloatArray
    shift_m: FloatArray


def _fitted(views: Sequence[BoardView], width_px: int, height_px: int) -> _Fit:
    points = [view.found.board.corners_m[view.found.corner].astype(np.float32) for view in views]
    pixels = [view.found.pixel.astype(np.float32).reshape(-1, 1, 2) for view in views]
    guess = np.array([[width_px * 0.82, 0.0, 0.5 * (width_px - 1)], [0.0, width_px * 0.82, 0.5 * (height_px - 1)],
                      [0.0, 0.0, 1.0]])  # fmt: skip
    # k3 cannot be told from k2 on a lens of 60 degrees, and bends the corners of the picture when it is let free.
    flags = cv2.CALIB_FIX_K3 | cv2.CALIB_USE_INTRINSIC_GUESS
    error, k, bend, turns, shifts, sd, _, view_error = cv2.calibrateCameraExtended(
        points, pixels, (width_px, height_px), guess, np.zeros(5), flags=flags
    )
    sd = np.asarray(sd).ravel()
    k1, k2, p1, p2, k3 = (float(value) for value in np.asarray(bend).ravel()[:5])
    camera = Camera(
        float(k[0, 0]), float(k[1, 1]), float(k[0, 2]), float(k[1, 2]), width_px, height_px, (k1, k2, p1, p2, k3),
        origin="calibration",
    )  # fmt: skip
    return _Fit(
        camera,
        float(max(sd[0], sd[1])),
        float(max(sd[2], sd[3])),
        float(error),
        np.asarray(view_error, dtype=np.float64).ravel(),
        np.array([np.ravel(turn) for turn in turns]),
        np.array([np.ravel(shift) for shift in shifts]),
    )
