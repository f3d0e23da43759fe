"""The wrist's angles of a session in another order: the papers', or that of the ISB (clinical reference 1.3).

The same turn has other angles in another order; sessions read in different orders are never compared.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core import so3
from carpus.core.hand.clinical_angles import angle_rates_matrix, isb_from_rotation
from carpus.core.session.values import AngleOrder, Motion, Session
from carpus.core.types import FloatArray, Side

_STEP_RAD = 1e-6


def in_order(session: Session, order: AngleOrder) -> Session:
    """The session with its wrist angles and their standard deviations in an order; its turns stay as they are."""
    if order == session.angle_order:
        return session
    if session.angle_order != "zyx":
        raise ValueError(f"a session in the order {session.angle_order}")
    side = session.header.hand
    smoothed = None if session.smoothed is None else _in_isb(session.smoothed, side)
    return replace(session, motion=_in_isb(session.motion, side), smoothed=smoothed, angle_order=order)


def _in_isb(motion: Motion, side: Side) -> Motion:
    turned = motion.rotation_w2_w0
    return replace(
        motion,
        angles_rad=isb_from_rotation(turned, side),
        angles_sd_rad=isb_sd_rad(turned, motion.angles_sd_rad, side),
    )


def isb_sd_rad(rotation_w2_w0: FloatArray, angles_sd_rad: FloatArray, side: Side) -> FloatArray:
    """Standard deviations (N, 3) of the ISB's angles, from those of the papers' angles taken as independent."""
    known = np.isfinite(rotation_w2_w0).all(axis=(1, 2)) & np.isfinite(angles_sd_rad).all(axis=1)
    out = np.full(angles_sd_rad.shape, np.nan)
    turned = rotation_w2_w0[known]
    steps = so3.exp(_STEP_RAD * np.eye(3))
    here = isb_from_rotation(turned, side)
    by_turn = np.stack([(isb_from_rotation(turned @ step, side) - here) / _STEP_RAD for step in steps], axis=-1)
    by_angles = by_turn @ np.linalg.inv(angle_rates_matrix(turned, side))
    out[known] = np.sqrt((by_angles**2 @ angles_sd_rad[known][:, :, None] ** 2)[..., 0])
    return out
