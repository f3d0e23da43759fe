"""Depth readings on a lattice: within an outline, and about discs.

Places are pixels, u to the right and v down; ``raw`` (H, W) is a depth picture in counts of ``unit_m`` metres, 0 for no
reading. The lattice stays where it is from picture to picture: the same errors then come again, and are not news.
"""

from __future__ import annotations

import cython
import numpy as np
from cython import double
from cython.cimports.libc.math import INFINITY, atan2, ceil, fabs, floor, hypot
from numpy.typing import NDArray


def sample_outline(
    raw: cython.const[cython.ushort][:, :],
    unit_m: double,
    corner_px: cython.const[double][:, :],
    wider: double,
    margin_px: double,
    step: cython.int,
    max_readings: cython.int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Sample the depths within an outline, at most so many: places (S, 2), depths (S,) in metres.

    The outline is that of the corners (C, 2), ``wider`` times as large about their mean, and ``margin_px`` more. Too
    many readings are thinned out evenly. None where the outline is off the picture or a corner is not known.
    """
    check_request(corner_px, step, max_readings)
    corners = corner_px.shape[0]
    middle_u: double = 0.0
    middle_v: double = 0.0
    for i in range(corners):
        middle_u += corner_px[i, 0]
        middle_v += corner_px[i, 1]
    middle_u, middle_v = middle_u / corners, middle_v / corners
    places = []  # angle about the middle, u and v, in order of the angle
    for i in range(corners):
        u_px, v_px = middle_u + wider * (corner_px[i, 0] - middle_u), middle_v + wider * (corner_px[i, 1] - middle_v)
        places.append((atan2(v_px - middle_v, u_px - middle_u), u_px, v_px))
    places.sort()
    outline: double[:, :] = np.array(places)[:, 1:]
    found = find_readings(raw, outline, margin_px, step, False)
    if found is None:
        return None
    # Twice the area of the triangle of an edge and a pixel is negative outside; by the margin it may be.
    edge: double[:, ::1] = np.empty((corners, 3))
    for i in range(corners):
        following = i + 1 if i + 1 < corners else 0
        edge[i, 0], edge[i, 1] = outline[following, 0] - outline[i, 0], outline[following, 1] - outline[i, 1]
        edge[i, 2] = margin_px * (hypot(edge[i, 0], edge[i, 1]) + 1e-9)
    place: cython.int[:, ::1] = found
    count: cython.int = 0
    for k in range(place.shape[0]):
        u, v = place[k, 0], place[k, 1]
        is_inside: cython.bint = True
        for i in range(corners):
            if edge[i, 0] * (v - outline[i, 1]) + edge[i, 2] < edge[i, 1] * (u - outline[i, 0]):
                is_inside = False
                break
        if is_inside:
            place[count, 0], place[count, 1] = u, v
            count += 1
    if count > max_readings:
        apart: double = (count - 1) / max(max_readings - 1.0, 1.0)
        for k in range(max_readings):
            at: cython.int = cython.cast(cython.int, k * apart) if k < max_readings - 1 else count - 1
            place[k, 0], place[k, 1] = place[at, 0], place[at, 1]
    return get_readings(raw, unit_m, place[: min(count, max_readings)])


def sample_discs(
    raw: cython.const[cython.ushort][:, :],
    unit_m: double,
    disc_px: cython.const[double][:, :],
    margin_px: double,
    step: cython.int,
    max_readings: cython.int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Sample the depths about discs, at most so many: places (S, 2), depths (S,) in metres.

    In the box of the discs (C, 2) and ``margin_px`` more. Of too many readings those nearest to a disc are taken, by
    rows and columns. None where there are none or a disc is not known.
    """
    check_request(disc_px, step, max_readings)
    found = find_readings(raw, disc_px, margin_px, step, True)
    if found is None or not len(found):
        return None
    place: cython.int[:, ::1] = found
    count: cython.int = place.shape[0]
    if count > max_readings:
        away = np.full(count, INFINITY)
        nearest: double[::1] = away
        for k in range(count):
            for i in range(disc_px.shape[0]):
                nearest[k] = min(nearest[k], fabs(place[k, 0] - disc_px[i, 0]) + fabs(place[k, 1] - disc_px[i, 1]))
        farthest: double = np.partition(away, max_readings - 1)[max_readings - 1]
        count = 0
        for k in range(place.shape[0]):
            if nearest[k] <= farthest and count < max_readings:
                place[count, 0], place[count, 1] = place[k, 0], place[k, 1]
                count += 1
    return get_readings(raw, unit_m, place[:count])


@cython.cfunc
def check_request(place_px: cython.const[double][:, :], step: cython.int, max_readings: cython.int) -> cython.bint:
    """Refuse what is no request for readings."""
    if place_px.shape[0] == 0 or place_px.shape[1] != 2:
        raise ValueError("places in the picture are wanted, u and v of each")
    if step < 1 or max_readings < 1:
        raise ValueError("a lattice has a step of at least one pixel, and at least one reading is wanted")
    return True


@cython.cfunc
def find_readings(
    raw: cython.const[cython.ushort][:, :],
    place_px: cython.const[double][:, :],
    margin_px: double,
    step: cython.int,
    is_outward: cython.bint,
) -> NDArray[np.int32] | None:
    """Find the lattice's readings (N, 2), u and v, in the box of some places and a margin, row by row.

    ``is_outward``: the box goes on to the next line of the lattice. None where it is off the picture or not known.
    """
    first, size = [0, 0], [0, 0]
    for axis in range(2):
        low: double = INFINITY
        high: double = -INFINITY
        for i in range(place_px.shape[0]):
            if not fabs(place_px[i, axis]) < INFINITY:
                return None
            low, high = min(low, place_px[i, axis] - margin_px), max(high, place_px[i, axis] + margin_px)
        if is_outward:
            low, high = floor(low / step) * step, ceil(high / step) * step
        low, high = step * ceil(max(low, 0.0) / step), min(high, raw.shape[1 - axis] - 1.0)
        if not low <= high:
            return None
        first[axis], size[axis] = cython.cast(cython.int, low), cython.cast(cython.int, (high - low) / step) + 1
    columns: cython.int = size[0]
    rows: cython.int = size[1]
    first_u: cython.int = first[0]
    first_v: cython.int = first[1]
    found = np.empty((rows * columns, 2), dtype=np.int32)
    place: cython.int[:, ::1] = found
    count: cython.int = 0
    for j in range(rows):
        for i in range(columns):
            u, v = first_u + i * step, first_v + j * step
            if raw[v, u] > 0:
                place[count, 0], place[count, 1] = u, v
                count += 1
    return found[:count]


@cython.cfunc
def get_readings(
    raw: cython.const[cython.ushort][:, :], unit_m: double, place: cython.int[:, :]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Get depths in single precision, as they are stored: tracked again from there they are the same."""
    pixel, depth = np.empty((place.shape[0], 2)), np.empty(place.shape[0])
    pixel_px: double[:, ::1] = pixel
    depth_m: double[::1] = depth
    for k in range(place.shape[0]):
        u, v = place[k, 0], place[k, 1]
        pixel_px[k, 0], pixel_px[k, 1] = u, v
        depth_m[k] = cython.cast(cython.float, raw[v, u] * unit_m)
    return pixel, depth
