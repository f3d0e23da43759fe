"""The wrist frame W, built from the palm's discs (clinical reference 1.1)."""

from __future__ import annotations

import numpy as np

from carpus.core.types import FloatArray

WRIST, CMC1, MCP2, MCP3, MCP4, MCP5 = range(6)
_PLANE = [WRIST, MCP2, MCP3, MCP4, MCP5]


def wrist_axes(palm_m: FloatArray, towards: FloatArray) -> FloatArray:
    """Axes of W as columns (..., 3, 3), in the frame in which the six palm discs (..., 6, 3) are given.

    X from WRIST to MCP3; Z the normal of the least-squares plane through WRIST and MCP2..MCP5, made
    perpendicular to X and turned to the side of the direction ``towards`` (3,); Y = Z x X.
    """
    x = palm_m[..., MCP3, :] - palm_m[..., WRIST, :]
    x = x / np.linalg.norm(x, axis=-1, keepdims=True)
    plane = palm_m[..., _PLANE, :]
    centred = plane - plane.mean(axis=-2, keepdims=True)
    _, vectors = np.linalg.eigh(np.swapaxes(centred, -1, -2) @ centred)
    normal = vectors[..., :, 0]
    side = np.where(normal @ towards < 0.0, -1.0, 1.0)
    normal = normal * side[..., None]
    z = normal - np.sum(normal * x, axis=-1, keepdims=True) * x
    z = z / np.linalg.norm(z, axis=-1, keepdims=True)
    return np.stack((x, np.cross(z, x), z), axis=-1)


def wrist_axes_sensitivity(palm_m: FloatArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Axes (3, 3) and the turn of those axes per metre of each disc coordinate, (3, 18), in W."""
    step_m = 1e-5
    moved = np.broadcast_to(palm_m, (19, 6, 3)).reshape(19, 18).copy()
    moved[np.arange(1, 19), np.arange(18)] += step_m
    axes = wrist_axes(moved.reshape(19, 6, 3), towards)
    turned = axes[0].T @ axes[1:]
    vee = 0.5 * np.stack(
        (
            turned[:, 2, 1] - turned[:, 1, 2],
            turned[:, 0, 2] - turned[:, 2, 0],
            turned[:, 1, 0] - turned[:, 0, 1],
        )
    )
    return axes[0], vee / step_m
