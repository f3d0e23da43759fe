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
    gate_squared: double,
    impossible: double,
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
    gate_squared : float
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
    cython.declare(prior=double, by_depth=double, by_outlier=double)
    prior, by_depth, by_outlier = densities
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
            # Squared Mahalanobis distances, and odds, by the pixel alone and with the depth.
            in_image = u * u / s_u + v * v / s_v
            in_space = in_image + z * z / s_z
            has_depth = isfinite(blob[i, 2])
            by_pixel: double = prior - 0.5 * (in_image + log(s_u * s_v))
            by_both: double = by_pixel + by_depth - 0.5 * (z * z / s_z + log(s_z))
            by_both = by_both if in_space <= gate_squared else impossible
            by_pixel = impossible if in_image > gate_squared else by_pixel + by_outlier if has_depth else by_pixel
            with_depth[j, i] = has_depth and by_both >= by_pixel
            value[j, i] = by_both if by_both >= by_pixel else by_pixel  # unknown where that by the pixel is
    return out, believed.view(np.bool_)
