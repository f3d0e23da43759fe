"""A disc of the palm begun anew: a person says that it lies elsewhere than was believed.

What was known of its place is given up, and the spot that was shown is measured once as if nothing had been: what the
rest of the palm leaves open of the pose stays open, and goes with the place from here on.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.palm_association import Measurements, update
from carpus.core.tracking.palm_state import SHAPE, SKIN, PalmEstimate
from carpus.core.tracking.palm_view import View, error_reset
from carpus.core.tracking.predicted_measurement import PredictedMeasurement, predicted_measurement
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.soft_tissue import stationary_covariance
from carpus.core.types import BoolArray, FloatArray

_TWICE = 2.0
"""The picture is read once more right after: half of its weight now, half then."""


def disc_anew(
    ahead: PredictedMeasurement, view: View, disc: int, blob: int, blobs: Measurements, settings: TrackerSettings
) -> tuple[PalmEstimate, ModeMixture, View]:
    """Estimate and mixture with the palm's ``disc`` (its row of 6) at a blob, and the view to go on with."""
    u_px, v_px, depth_m = blobs.value[blob]
    depth_m = depth_m if np.isfinite(depth_m) else float(ahead.mean[disc, 2])
    estimate = ahead.nominal
    in_camera = view.camera.back_project(np.array([[u_px, v_px]]), np.array([depth_m]))[0]
    in_w0 = view.rotation_w0_cam.T @ (in_camera - view.translation_w0_cam_m)
    on_palm_m = estimate.rotation_w2_w0.T @ (in_w0 - estimate.position_m)

    shape, skin = (np.arange(part.start + 3 * disc, part.start + 3 * disc + 3) for part in (SHAPE, SKIN))
    own = np.concatenate((shape, skin))
    fresh = np.zeros((6, 6))
    fresh[:3, :3] = settings.said.anywhere_m**2 * np.eye(3)
    fresh[3:, 3:] = stationary_covariance(settings.tissue)[skin[:, None], skin]
    value = estimate.value.copy()
    value[shape], value[skin] = on_palm_m - view.palm_m[disc], 0.0
    estimate = PalmEstimate(estimate.rotation_w2_w0, value, _with_block(estimate.covariance, own, fresh))
    mean = ahead.mixture.mean.copy()
    mean[..., own] = 0.0
    mixture = ModeMixture(mean, _with_block(ahead.mixture.covariance, own, fresh), ahead.mixture.probability)

    # How wrong its depth was at the calibration says nothing of it any more.
    hidden = view.hidden.copy()
    hidden[disc, 3 * disc : 3 * disc + 3] = 0.0
    view = replace(view, hidden=hidden)
    assigned: NDArray[np.int64] = np.full(len(ahead.mean), -1, dtype=np.int64)
    assigned[disc] = blob
    with_depth: BoolArray = (assigned >= 0) & np.isfinite(blobs.value[blob, 2])
    whole = predicted_measurement(estimate, mixture, view, settings.spread)
    measured = update(whole, blobs, assigned, with_depth, np.full((assigned.size, 3), _TWICE))
    return *error_reset(estimate, measured.mixture), view


def with_discs_as_known(view: View, shape: FloatArray, named: BoolArray) -> View:
    """The view in which to look for the hand anew: the discs that a person ``named`` (6,) where they are by now, by the
    shape (18,)."""
    if not named.any():
        return view
    return replace(view, palm_m=view.palm_m + np.where(named[:, None], shape.reshape(-1, 3), 0.0))


def _with_block(covariance: FloatArray, rows: NDArray[np.int64], block: FloatArray) -> FloatArray:
    """A covariance (..., n, n) in which those rows go with nothing else, and with each other as in ``block``."""
    out = covariance.copy()
    out[..., rows, :] = 0.0
    out[..., :, rows] = 0.0
    out[..., rows[:, None], rows] = block
    return out
