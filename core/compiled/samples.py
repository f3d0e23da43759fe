"""Depth readings on a lattice: within an outline, and about discs.

Places are pixels, u to the right and v down; ``raw`` (H, W) is a depth picture in counts of ``unit_m`` metres, 0 for no
reading. The lattice stays where it is from picture to picture: the same errors then come again, and are not news.
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.libc.math import INFINITY, atan2, ceil, fabs, floor, hypot
from numpy.typing import NDArray


def sample_outline(
    raw: cython.const[cython.ushort][:, :],
    unit_m: cython.double,
    corner_px: cython.const[cython.double][:, :],
    wider: cython.double,
    margin_px: cython.double,
    step: cython.int,
    max_readings: cython.int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Sample the depths within an outline, at most so many: places (S, 2), depths (S,) in metres.

    The outline is that of the corners (C, 2), ``wider`` times as large about their mean, and ``margin_px`` more. Too
    many readings are thinned out evenly. None where the outline is off the picture or a corner is not known.
    """
    check_request(corner_px.shape[0], corner_px.shape[1], step, max_readings)
    height, width = cython.cast(cython.int, raw.shape[0]), cython.cast(cython.int, raw.shape[1])
    corners = corner_px.shape[0]
    middle_u: cython.double = 0.0
    middle_v: cython.double = 0.0
    for i in range(corners):
        middle_u += corner_px[i, 0]
        middle_v += corner_px[i, 1]
    middle_u, middle_v = middle_u / corners, middle_v / corners
    if not (fabs(middle_u) < INFINITY and fabs(middle_v) < INFINITY):
        return None
    places = []  # angle about the middle, u and v, in order of the angle
    for i in range(corners):
        u_px, v_px = middle_u + wider * (corner_px[i, 0] - middle_u), middle_v + wider * (corner_px[i, 1] - middle_v)
        places.append((atan2(v_px - middle_v, u_px - middle_u), u_px, v_px))
    places.sort()
    outline: cython.double[:, ::1] = np.array(places)[:, 1:].copy()
    left: cython.double = INFINITY
    top: cython.double = INFINITY
    right: cython.double = -INFINITY
    bottom: cython.double = -INFINITY
    # Twice the area of the triangle of an edge and a pixel is negative outside; by the margin it may be.
    edge: cython.double[:, ::1] = np.empty((corners, 3))
    for i in range(corners):
        left, right = min(left, outline[i, 0] - margin_px), max(right, outline[i, 0] + margin_px)
        top, bottom = min(top, outline[i, 1] - margin_px), max(bottom, outline[i, 1] + margin_px)
        following = i + 1 if i + 1 < corners else 0
        edge[i, 0], edge[i, 1] = outline[following, 0] - outline[i, 0], outline[following, 1] - outline[i, 1]
        edge[i, 2] = margin_px * (hypot(edge[i, 0], edge[i, 1]) + 1e-9)
    if not (left < width and top < height and right >= 0.0 and bottom >= 0.0):
        return None
    first_u = step * cython.cast(cython.int, ceil(max(left, 0.0) / step))
    first_v = step * cython.cast(cython.int, ceil(max(top, 0.0) / step))
    last_u, last_v = (
        cython.cast(cython.int, min(right, width - 1.0)),
        cython.cast(cython.int, min(bottom, height - 1.0)),
    )
    if last_u < first_u or last_v < first_v:
        return None

    rows, columns = (last_v - first_v) // step + 1, (last_u - first_u) // step + 1
    found: cython.int[:, ::1] = np.empty((rows * columns, 2), dtype=np.int32)
    count: cython.int = 0
    for j in range(rows):
        for i in range(columns):
            u, v = first_u + i * step, first_v + j * step
            is_inside: cython.bint = raw[v, u] > 0
            for k in range(corners):
                if edge[k, 0] * (v - outline[k, 1]) + edge[k, 2] < edge[k, 1] * (u - outline[k, 0]):
                    is_inside = False
                    break
            if is_inside:
                found[count, 0], found[count, 1] = u, v
                count += 1
    if count > max_readings:
        apart: cython.double = (count - 1) / max(max_readings - 1.0, 1.0)
        for k in range(max_readings):
            at: cython.int = cython.cast(cython.int, k * apart) if k < max_readings - 1 else count - 1
            found[k, 0], found[k, 1] = found[at, 0], found[at, 1]
    return take_readings(raw, unit_m, found[: min(count, max_readings)])


def sample_discs(
    raw: cython.const[cython.ushort][:, :],
    unit_m: cython.double,
    disc_px: cython.const[cython.double][:, :],
    margin_px: cython.double,
    step: cython.int,
    max_readings: cython.int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Sample the depths about discs, at most so many: places (S, 2), depths (S,) in metres.

    In the box of the discs (C, 2) and ``margin_px`` more. Of too many readings those nearest to a disc are taken, by
    rows and columns. None where there are none or a disc is not known.
    """
    check_request(disc_px.shape[0], disc_px.shape[1], step, max_readings)
    height, width = cython.cast(cython.int, raw.shape[0]), cython.cast(cython.int, raw.shape[1])
    left: cython.double = INFINITY
    top: cython.double = INFINITY
    right: cython.double = -INFINITY
    bottom: cython.double = -INFINITY
    for i in range(disc_px.shape[0]):
        if not (fabs(disc_px[i, 0]) < INFINITY and fabs(disc_px[i, 1]) < INFINITY):
            return None
        left, right = min(left, disc_px[i, 0] - margin_px), max(right, disc_px[i, 0] + margin_px)
        top, bottom = min(top, disc_px[i, 1] - margin_px), max(bottom, disc_px[i, 1] + margin_px)
    left, right = max(floor(left / step) * step, 0.0), min(ceil(right / step) * step, width - 1.0)
    top, bottom = max(floor(top / step) * step, 0.0), min(ceil(bottom / step) * step, height - 1.0)
    if not (left <= right and top <= bottom):
        return None
    first_u, first_v = cython.cast(cython.int, left), cython.cast(cython.int, top)
    last_u, last_v = cython.cast(cython.int, right), cython.cast(cython.int, bottom)

    rows, columns = (last_v - first_v) // step + 1, (last_u - first_u) // step + 1
    found: cython.int[:, ::1] = np.empty((rows * columns, 2), dtype=np.int32)
    count: cython.int = 0
    for j in range(rows):
        for i in range(columns):
            u, v = first_u + i * step, first_v + j * step
            if raw[v, u] > 0:
                found[count, 0], found[count, 1] = u, v
                count += 1
    if count == 0:
        return None
    if count > max_readings:
        away = np.empty(count)
        nearest: cython.double[::1] = away
        for k in range(count):
            nearest[k] = INFINITY
            for i in range(disc_px.shape[0]):
                apart = fabs(found[k, 0] - disc_px[i, 0]) + fabs(found[k, 1] - disc_px[i, 1])
                nearest[k] = min(nearest[k], apart)
        farthest: cython.double = np.partition(away, max_readings - 1)[max_readings - 1]
        kept: cython.int = 0
        for k in range(count):
            if nearest[k] <= farthest and kept < max_readings:
                found[kept, 0], found[kept, 1] = found[k, 0], found[k, 1]
                kept += 1
        count = kept
    return take_readings(raw, unit_m, found[:count])


@cython.cfunc
def check_request(
    places: cython.Py_ssize_t, numbers: cython.Py_ssize_t, step: cython.int, max_readings: cython.int
) -> cython.bint:
    """Refuse what is no request for readings."""
    if places == 0 or numbers != 2:
        raise ValueError("places in the picture are wanted, u and v of each")
    if step < 1 or max_readings < 1:
        raise ValueError("a lattice has a step of at least one pixel, and at least one reading is wanted")
    return True


@cython.cfunc
def take_readings(
    raw: cython.const[cython.ushort][:, :], unit_m: cython.double, place: cython.int[:, :]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Take depths in single precision, as they are stored: tracked again from there they are the same."""
    pixel, depth = np.empty((place.shape[0], 2)), np.empty(place.shape[0])
    pixel_px: cython.double[:, ::1] = pixel
    depth_m: cython.double[::1] = depth
    for k in range(place.shape[0]):
        u, v = place[k, 0], place[k, 1]
        pixel_px[k, 0], pixel_px[k, 1] = u, v
        depth_m[k] = cython.cast(cython.float, raw[v, u] * unit_m)
    return pixel, depth
