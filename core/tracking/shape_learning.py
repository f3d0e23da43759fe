"""How the palm's shape is learnt while it moves, of measurements whose errors do not come anew with every frame.

The matching window flattens knuckles: a part of a disc's error in depth stays over a recording, and the calibration had
it too. What corrects a disc's place is then partly its depth that goes on being wrong. Shading and the pattern of the
depths stay as long as the pose does: neighbouring frames tell little that is new of the shape.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from core.calibration.result import Calibration
from core.tracking.modes import ModeBank
from core.tracking.state import StateLayout
from core.types import FloatArray


def along_rays(calibration: Calibration, sd_m: float) -> FloatArray:
    """Covariances (M, 3, 3) in W0 of errors along the rays from the camera, ``sd_m`` in depth."""
    place = _cam_m(calibration)
    ray = (place / place[:, 2:]) @ calibration.rotation_w0_cam
    return np.asarray(sd_m**2 * ray[:, :, None] * ray[:, None, :])


def hidden_by_calibration(calibration: Calibration, share: float) -> FloatArray:
    """What a shape (3M,) takes from the depths (M,) of every pose: matrix (M, 3M).

    Its effect on the calibration's depths times the ``share`` of it that is their error: by that much the discs lie
    elsewhere without ever being seen there.
    """
    count = len(calibration.marker_position_w0_m)
    disc = np.arange(count)
    out = np.zeros((count, count, 3))
    out[disc, disc] = share * calibration.rotation_w0_cam[2]
    return out.reshape(count, -1)


def _cam_m(calibration: Calibration) -> FloatArray:
    return calibration.marker_position_w0_m @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m


def slowly_learnt(before: ModeBank, after: ModeBank, layout: StateLayout, news: float) -> ModeBank:
    """A correction of which the shape takes only the share ``news`` of the information (0 to 1).

    The partial update of Brink (2017): the rest of the state is corrected as ever, and the covariance stays one.
    """
    if not layout.shape_count:
        return after
    kept, kept_both = _kept(layout, news)
    return ModeBank(
        after.nominal,
        after.error + kept * (before.error - after.error),
        after.covariance + kept_both * (before.covariance - after.covariance),
        after.probability,
    )


@lru_cache(maxsize=8)
def _kept(layout: StateLayout, news: float) -> tuple[FloatArray, FloatArray]:
    kept = np.zeros(layout.size)
    kept[layout.shape] = np.sqrt(1.0 - news)
    return kept, np.outer(kept, kept)
