"""Odds that a blob is a marker, eq. (12) of the wrist paper."""

from __future__ import annotations

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.libc.math import isfinite, log
from numpy.typing import NDArray

from carpus.core.compiled.palm import as_array

Array = NDArray[np.float64]


def compute_log_odds(
    predicted: Array,
    covariance: Array,
    measured: Array,
    noise_variance: Array,
    densities: tuple[float, float, float],
    gate2: float,
    impossible: float,
) -> tuple[Array, NDArray[np.bool_]]:
    """
    Compute the log of (12) for every marker over (12) for clutter.

    With innovations y and their covariance S it is the log of N(y; 0, S) over clutter's density: by pixel and depth, or
    by the pixel alone where there is no depth or it is of something else.

    Parameters
    ----------
    predicted, covariance : numpy.ndarray
        Pixel u, v and depth z of the markers (M, 3), and their covariance (M, 3, 3).
    measured, noise_variance : numpy.ndarray
        Those of the blobs (D, 3), NaN where there is no depth, and their variances (D, 3).
    densities : tuple of float
        Logs of a marker's prior over clutter's in the picture, of clutter's in depth, and of the chance that a depth is
        of something else.
    gate2 : float
        From which y' S^-1 y on a blob is not that marker.
    impossible : float
        The value there.

    Returns
    -------
    tuple of numpy.ndarray
        The odds (M, D), and whether the blob's depth is believed (M, D).
    """
    markers: Py_ssize_t = len(predicted)
    blobs: Py_ssize_t = len(measured)
    at: cython.const[double][:, ::1] = as_array(predicted, "what is predicted", (markers, 3))
    wide: cython.const[double][:, :, ::1] = as_array(covariance, "its covariance", (markers, 3, 3))
    blob: cython.const[double][:, ::1] = as_array(measured, "what is measured", (blobs, 3))
    noise: cython.const[double][:, ::1] = as_array(noise_variance, "its variance", (blobs, 3))
    out, believed = np.empty((markers, blobs)), np.empty((markers, blobs), dtype=np.uint8)
    value: double[:, ::1] = out
    with_depth: cython.uchar[:, ::1] = believed
    fill_log_odds(at, wide, blob, noise, densities[0], densities[1], densities[2], gate2, impossible, value, with_depth)
    return out, believed.view(np.bool_)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fill_log_odds(
    at: cython.const[double][:, ::1],
    wide: cython.const[double][:, :, ::1],
    blob: cython.const[double][:, ::1],
    noise: cython.const[double][:, ::1],
    prior: double,
    by_depth: double,
    by_outlier: double,
    gate2: double,
    impossible: double,
    value: double[:, ::1],
    with_depth: cython.uchar[:, ::1],
) -> cython.void:
    """Fill in what :func:`compute_log_odds` returns."""
    j: Py_ssize_t
    i: Py_ssize_t
    for j in range(at.shape[0]):
        for i in range(blob.shape[0]):
            # S = L D L': innovations u, v, z and their variances, each given those before it.
            u = blob[i, 0] - at[j, 0]
            s_u = wide[j, 0, 0] + noise[i, 0]
            v_by_u = wide[j, 0, 1] / s_u
            v = blob[i, 1] - at[j, 1] - v_by_u * u
            s_v = wide[j, 1, 1] + noise[i, 1] - v_by_u * wide[j, 0, 1]
            vz = wide[j, 1, 2] - v_by_u * wide[j, 0, 2]
            z_by_u, z_by_v = wide[j, 0, 2] / s_u, vz / s_v
            z = blob[i, 2] - at[j, 2] - z_by_u * u - z_by_v * v
            s_z = wide[j, 2, 2] + noise[i, 2] - z_by_u * wide[j, 0, 2] - z_by_v * vz
            flat2 = u * u / s_u + v * v / s_v
            whole2 = flat2 + z * z / s_z
            has_depth = isfinite(blob[i, 2])
            flat = prior - 0.5 * (flat2 + log(s_u * s_v))
            whole = flat + by_depth - 0.5 * (z * z / s_z + log(s_z)) if whole2 <= gate2 else impossible
            flat = impossible if flat2 > gate2 else flat + by_outlier if has_depth else flat
            with_depth[j, i] = has_depth and whole >= flat
            value[j, i] = whole if whole >= flat else flat  # unknown where that by the pixel is


def find_likeliest(odds: Array) -> NDArray[np.int64] | None:
    """
    Find the likeliest blob of every marker; where these are all others, none better can be had.

    Parameters
    ----------
    odds : numpy.ndarray
        Log odds (M, D).

    Returns
    -------
    numpy.ndarray or None
        Blob (M,) of every marker, -1 where no odds are above zero; None where two take the same.
    """
    markers: Py_ssize_t = odds.shape[0]
    blobs: Py_ssize_t = odds.shape[1]
    value: cython.const[double][:, ::1] = as_array(odds, "odds", (markers, blobs))
    out = np.empty(markers, dtype=np.int64)
    taken: cython.longlong[::1] = out
    taken[:] = -1
    is_used: cython.uchar[::1] = np.zeros(blobs, dtype=np.uint8)
    j: Py_ssize_t
    i: Py_ssize_t
    for j in range(markers):
        best: double = 0.0
        for i in range(blobs):
            if value[j, i] > best:
                best = value[j, i]
                taken[j] = i
        if taken[j] >= 0:
            if is_used[taken[j]]:
                return None
            is_used[taken[j]] = 1
    return out
