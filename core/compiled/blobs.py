"""Blobs of the paper's colour: found, touching discs taken apart, and measured.

Pictures (H, W) have u to the right and v down. A pixel's look is its hue + 256 saturation. Sums of pixels are whole
numbers or of double precision.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.libc.math import INFINITY, M_PI, NAN, atan2, cos, fabs, hypot, rint, sin, sqrt
from numpy.typing import NDArray

LONG_SIDE_RADII = 2.8
"""A blob whose box is longer is more than one disc, facing any way."""
LONG_AXIS_RADII = 0.72
"""So is one whose pixels scatter more along their main axis; of a disc it is one half."""
BLURRED_EDGE_PX = 0.5
"""By so much a blurred edge widens every disc, large or small."""
SPLIT_ROUNDS = 6
"""A long blob is taken apart in so many rounds."""
MAX_PARTS = 4
"""At most, as a row of knuckles; what is longer than one more would be is none of discs."""

PAPER_LOW = 0.2
"""Shares of paper in a pixel below count as none; with :data:`PAPER_HIGH` symmetric, so an edge's centre stays."""
PAPER_HIGH = 0.8
"""Shares of paper in a pixel above count as all."""
MIN_RIM = 3.0
"""With fewer pixels in a direction of the rim all of the rim is taken."""
MIN_CORE = 4.0
"""With fewer pixels in the core all of the blob is taken."""

DEPTH_VALID_SHARE = 0.3
"""With fewer of its pixels read a blob's depth is not trusted (reference 7.2)."""
DEPTH_IQR_M = 0.008
"""Nor is one whose readings spread by more (reference 7.2)."""
MIN_READINGS = 3
"""So many make a depth."""
SLOPE_SHARE = 0.35
"""On a steep surface half a pixel between the two pictures is a depth error of this share of the spread."""
EDGE_STEP_M = 0.015
"""A reading this far from the blob's is of another surface."""
EDGE_SD_M = 0.008
"""The depth's sd if all around were of another."""

OTHER = cython.declare(cython.int, 0)  # of a window's pixel: off the picture, or of another blob
OWN = cython.declare(cython.int, 1)
FREE = cython.declare(cython.int, 2)  # of no blob


def mask_paper(
    hsv: cython.const[cython.uchar][:, :, ::1], is_paper: cython.const[cython.uchar][::1], darkest: double
) -> NDArray[np.uint8]:
    """Mask (H, W) the pixels of ``hsv`` (H, W, 3) that look like paper and are lit.

    ``is_paper`` (65536,) is 255 for a look of paper and 0 for any other, as the mask becomes.
    """
    if hsv.shape[2] != 3 or is_paper.shape[0] != 65536:
        raise ValueError("a picture of three channels is wanted, and a table of 65536 looks")
    out = np.empty((hsv.shape[0], hsv.shape[1]), dtype=np.uint8)
    mask: cython.uchar[:, ::1] = out
    for v in range(hsv.shape[0]):
        for u in range(hsv.shape[1]):
            mask[v, u] = is_paper[hsv[v, u, 0] | hsv[v, u, 1] << 8] if hsv[v, u, 2] > darkest else 0
    return out


def find_blobs(
    mask: cython.const[cython.uchar][:, :],
    radius_at: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    min_share: double,
    max_share: double,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Find the blobs of a mask that are about as large as a disc, touching discs taken apart.

    Parameters
    ----------
    mask
        (H, W), 0 where there is none. Pixels that touch, also at a corner, are of one blob.
    radius_at
        Gives the radius (N,) in pixels of a disc facing the camera at places (N, 2).
    min_share, max_share
        Of such a disc's area, that a blob may have.

    Returns
    -------
    labels (H, W) of all, 0 for none; of the B blobs that fit label (B,), centre (B, 2) u and v, area (B,) in whole
    pixels and radius (B,) of a disc there
    """
    height, width = mask.shape[0], mask.shape[1]
    run: cython.int[:, ::1] = np.empty((height * ((width + 1) // 2), 5), dtype=np.int32)
    runs = find_runs(mask, run)
    count: cython.int = 0
    for i in range(runs):
        if run[i, 3] == i:
            count += 1
    labels, numbers = np.zeros((height, width), dtype=np.int32), np.empty(count * MAX_PARTS, dtype=np.int32)
    label: cython.int[:, ::1] = labels
    number: cython.int[::1] = numbers
    # Pixels, their u and their v summed; left, top and just beyond right and bottom.
    total: cython.longlong[:, ::1] = np.zeros((count, 7), dtype=np.int64)
    following = 0
    for i in range(runs):
        v, left, right = run[i, 0], run[i, 1], run[i, 2]
        if run[i, 3] == i:
            total[following, 3], total[following, 4] = left, v
            following += 1
            run[i, 4] = following
        else:
            run[i, 4] = run[first_run(run, i), 4]
        k = run[i, 4] - 1
        total[k, 0] += right - left
        total[k, 1] += (right - left) * (left + right - 1) // 2
        total[k, 2] += (right - left) * v
        total[k, 3], total[k, 5], total[k, 6] = min(total[k, 3], left), max(total[k, 5], right), v + 1
        for u in range(left, right):
            label[v, u] = k + 1
    facts = np.empty((count * MAX_PARTS, 4))
    fact: double[:, ::1] = facts  # u, v, area, radius
    for k in range(count):
        fact[k, 2] = total[k, 0]
        fact[k, 0], fact[k, 1] = total[k, 1] / fact[k, 2], total[k, 2] / fact[k, 2]
    facts[:count, 3] = radius_at(facts[:count, :2])

    sums: cython.longlong[:, ::1] = np.empty((MAX_PARTS, 6), dtype=np.int64)
    long_side: double = LONG_SIDE_RADII
    blurred: double = BLURRED_EDGE_PX
    for k in range(count):
        left_px, top_px, right_px, bottom_px = total[k, 3], total[k, 4], total[k, 5], total[k, 6]
        if max(right_px - left_px, bottom_px - top_px) > long_side * (fact[k, 3] + blurred):
            box = label[top_px:bottom_px, left_px:right_px]
            pixels = np.zeros((4, total[k, 0]), dtype=np.int32)
            parts = split_blob(box, k + 1, following + 1, fact[k, 3], pixels, sums)
            for part in range(parts):
                to = following + part - 1 if part else k
                fact[to, 2], fact[to, 3] = sums[part, 0], fact[k, 3]
                fact[to, 0] = (sums[part, 1] + left_px * sums[part, 0]) / fact[to, 2]
                fact[to, 1] = (sums[part, 2] + top_px * sums[part, 0]) / fact[to, 2]
            following += max(parts - 1, 0)

    kept = 0
    for k in range(following):
        if min_share <= fact[k, 2] / (M_PI * (fact[k, 3] * fact[k, 3])) <= max_share:
            number[kept] = k + 1
            fact[kept, :] = fact[k, :]
            kept += 1
    return labels, numbers[:kept], facts[:kept, :2], facts[:kept, 2], facts[:kept, 3]


@cython.cfunc
@cython.exceptval(check=False)
def find_runs(mask: cython.const[cython.uchar][:, :], run: cython.int[:, ::1]) -> cython.int:
    """Find the runs of pixels side by side, and return how many.

    ``run`` (N, 5) becomes row, left, just beyond right, and a run of the same blob, of the first one itself.
    """
    width = mask.shape[1]
    count: cython.int = 0
    above: cython.int = 0  # the first run of the row above that may touch
    for v in range(mask.shape[0]):
        begin = count
        u: cython.int = 0
        while u < width:
            if mask[v, u] == 0:
                u += 1
                continue
            left = u
            while u < width and mask[v, u] != 0:
                u += 1
            run[count, 0], run[count, 1], run[count, 2], run[count, 3] = v, left, u, count
            while above < begin and run[above, 2] < left:
                above += 1
            other = above
            while other < begin and run[other, 1] <= u:
                one, two = first_run(run, count), first_run(run, other)
                run[max(one, two), 3] = min(one, two)
                other += 1
            count += 1
        above = begin
    return count


@cython.cfunc
@cython.exceptval(check=False)
def first_run(run: cython.int[:, ::1], i: cython.int) -> cython.int:
    """Look up the first run of the blob that a run is of, and shorten the way there."""
    while run[i, 3] != i:
        run[i, 3] = run[run[i, 3], 3]
        i = run[i, 3]
    return i


@cython.cfunc
def split_blob(
    labels: cython.int[:, :],
    label: cython.int,
    following: cython.int,
    radius_px: double,
    pixels: cython.int[:, ::1],
    sums: cython.longlong[:, ::1],
) -> cython.int:
    """Take a blob apart that is longer than a disc of this radius, and return in how many parts, 0 for none.

    ``labels`` (H, W) of its box: the first part keeps ``label``, the others are numbered from ``following`` on. Their
    sums are put into ``sums``, see :func:`sum_parts`. A blob that is one disc or far more than a few stays whole.
    ``pixels`` (4, P), all zero, is room for its P pixels.
    """
    u, v, part, best = pixels[0], pixels[1], pixels[2], pixels[3]
    # Its pixels, and the main axis of their scatter.
    count: cython.int = 0
    for j in range(labels.shape[0]):
        for i in range(labels.shape[1]):
            if labels[j, i] == label:
                u[count], v[count] = i, j
                count += 1
    sum_parts(u, v, part, sums[:1])
    n: double = sums[0, 0]
    mean_u, mean_v = sums[0, 1] / n, sums[0, 2] / n
    xx, yy = sums[0, 3] / n - mean_u * mean_u, sums[0, 4] / n - mean_v * mean_v
    xy = sums[0, 5] / n - mean_u * mean_v
    long_axis: double = LONG_AXIS_RADII * (radius_px + BLURRED_EDGE_PX)
    if sqrt(0.5 * (xx + yy) + hypot(0.5 * (xx - yy), xy)) <= long_axis:
        return 0
    tilt = 0.5 * atan2(2.0 * xy, xx - yy)
    across, down = cos(tilt), sin(tilt)
    low: double = INFINITY
    high: double = -INFINITY
    for p in range(count):
        along = u[p] * across + v[p] * down
        low, high = min(low, along), max(high, along)

    # Blurred edges make small discs larger than they are, so a row of them may hold one less than its length says.
    most: cython.int = MAX_PARTS
    length = rint((high - low - 2.0 * radius_px) / (2.0 * radius_px)) + 1.0
    if not length <= most + 1:
        return 0
    longest: cython.int = max(2, cython.cast(cython.int, length))
    least: double = INFINITY
    found: cython.int = 0
    for parts in range(max(2, longest - 1), min(longest, most) + 1):
        if parts == 2:  # the line between two discs crosses the main axis in the middle of the blob
            for p in range(count):
                part[p] = u[p] * across + v[p] * down > 0.5 * (high + low)
        else:
            middle: double[:, ::1] = np.empty((parts, 5))
            gap = (high - low - 2.0 * radius_px) / (parts - 1)
            for k in range(parts):
                along = low + radius_px - (mean_u * across + mean_v * down) + gap * k
                middle[k, 0], middle[k, 1] = mean_u + along * across, mean_v + along * down
            if not assign_pixels(u, v, part, middle):
                continue
        sum_parts(u, v, part, sums[:parts])
        elongation = mean_elongation(sums[:parts])
        if elongation < least:
            least, found = elongation, parts
            best[:] = part
    if found:
        sum_parts(u, v, best, sums[:found])
        for p in range(count):
            if best[p]:
                labels[v[p], u[p]] = following + best[p] - 1
    return found


@cython.cfunc
def assign_pixels(u: cython.int[::1], v: cython.int[::1], part: cython.int[::1], middle: double[:, ::1]) -> cython.bint:
    """Give each pixel to the nearest of N middles, and move these to their pixels, until no pixel changes.

    ``middle`` (N, 5) u and v, and room for sums of 1, u and v. False where a middle would have no pixel.
    """
    rounds: cython.int = SPLIT_ROUNDS
    for turn in range(rounds):
        is_settled: cython.bint = turn > 0
        middle[:, 2:] = 0.0
        for p in range(part.shape[0]):
            nearest: cython.int = 0
            least: double = INFINITY
            for k in range(middle.shape[0]):
                x, y = u[p] - middle[k, 0], v[p] - middle[k, 1]
                apart = sqrt(x * x + y * y)
                if apart < least:
                    nearest, least = k, apart
            is_settled = is_settled and part[p] == nearest
            part[p] = nearest
            middle[nearest, 2] += 1.0
            middle[nearest, 3] += u[p]
            middle[nearest, 4] += v[p]
        for k in range(middle.shape[0]):
            if middle[k, 2] == 0.0:
                return False
            middle[k, 0], middle[k, 1] = middle[k, 3] / middle[k, 2], middle[k, 4] / middle[k, 2]
        if is_settled:
            break
    return True


@cython.cfunc
@cython.exceptval(check=False)
def sum_parts(u: cython.int[::1], v: cython.int[::1], part: cython.int[::1], out: cython.longlong[:, :]) -> cython.void:
    """Sum 1, u, v, u^2, v^2 and u v over the pixels of each part, into ``out`` (N, 6)."""
    out[:] = 0
    for p in range(part.shape[0]):
        k, i, j = part[p], u[p], v[p]
        out[k, 0] += 1
        out[k, 1] += i
        out[k, 2] += j
        out[k, 3] += i * i
        out[k, 4] += j * j
        out[k, 5] += i * j


@cython.cfunc
@cython.exceptval(check=False)
def mean_elongation(sums: cython.longlong[:, :]) -> double:
    """Mean of (a - b) / (a + b) over the parts, with second moments a and b along their axes: 0 for discs."""
    total: double = 0.0
    for k in range(sums.shape[0]):
        n: double = sums[k, 0]
        u: double = sums[k, 1]
        v: double = sums[k, 2]
        uu, vv, uv = sums[k, 3] - u * u / n, sums[k, 4] - v * v / n, sums[k, 5] - u * v / n
        total += hypot(uu - vv, 2.0 * uv) / max(uu + vv, 1e-12)
    return total / sums.shape[0]


@cython.cclass
class BlobWindows:
    """Round windows of P pixels about B blobs, in which these are measured.

    Parameters
    ----------
    blobs
        ``Components``: ``labels`` (H, W) with each pixel's blob, 0 for none; ``label`` (B,) and ``centre_px`` (B, 2).
    stencil
        ``Stencil``: where the window's pixels lie about its middle, and what they are for.
    """

    count: cython.int
    height: cython.int
    width: cython.int
    offset: cython.const[cython.int][:, ::1]  # (P, 2) v and u from the middle
    middle: cython.int[:, ::1]  # (B, 2) v and u of the pixel in the middle
    whose: cython.uchar[:, ::1]  # (B, P) OWN, FREE or OTHER
    stencil: object
    core: cython.int
    rim_from: cython.int
    rim_to: cython.int

    def __init__(self, blobs: Any, stencil: Any) -> None:
        labels: cython.const[cython.int][:, :] = blobs.labels
        own: cython.const[cython.int][:] = blobs.label
        centre_px: cython.const[double][:, :] = blobs.centre_px
        self.stencil, self.offset = stencil, stencil.offset
        self.core, self.rim_from, self.rim_to = stencil.core.stop, stencil.rim.start, stencil.rim.stop
        self.height, self.width = labels.shape[0], labels.shape[1]
        self.count, pixels = own.shape[0], self.offset.shape[0]
        if centre_px.shape[0] != self.count or centre_px.shape[1] != 2 or self.offset.shape[1] != 2:
            raise ValueError("labels and centres of blobs, or a stencil, are not of the sizes that belong together")
        if not (0 <= self.core <= pixels and 0 <= self.rim_from <= self.rim_to <= pixels):
            raise ValueError("a stencil's parts are not within its window")
        self.middle = np.empty((self.count, 2), dtype=np.int32)
        self.whose = np.zeros((self.count, pixels), dtype=np.uint8)
        offset: cython.const[cython.int][:, ::1] = self.offset
        whose: cython.uchar[:, ::1] = self.whose
        height, width = self.height, self.width
        for b in range(self.count):
            u0, v0 = rint(centre_px[b, 0]), rint(centre_px[b, 1])
            if not (0.0 <= u0 < width and 0.0 <= v0 < height):
                raise ValueError("a blob's centre is off its picture")
            i, j, label = cython.cast(cython.int, u0), cython.cast(cython.int, v0), own[b]
            self.middle[b, 0], self.middle[b, 1] = j, i
            for p in range(pixels):
                v, u = j + offset[p, 0], i + offset[p, 1]
                if 0 <= v < height and 0 <= u < width:
                    if labels[v, u] == label:
                        whose[b, p] = OWN
                    elif labels[v, u] == 0:
                        whose[b, p] = FREE

    def compare_colors(
        self, hsv: cython.const[cython.uchar][:, :, :], table: Any
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Compare each blob's colours to the paper's, and those of its rim to skin.

        ``hsv`` (H, W, 3) and a ``ColorTable``. Returns the Bhattacharyya coefficients (B,), from 0 to 1, and the shares
        (B,) of skin in the rims.
        """
        cell: cython.const[cython.uchar][::1] = table.cell
        is_skin: cython.const[cython.uchar][::1] = table.is_skin
        reference: cython.const[double][::1] = table.root_of_share
        self.check_picture(hsv.shape[0], hsv.shape[1])
        if hsv.shape[2] != 3 or cell.shape[0] != 65536 or is_skin.shape[0] != 65536 or reference.shape[0] != 256:
            raise ValueError("a picture of three channels is wanted, and tables of 65536 colours in 256 cells")
        found = np.zeros((2, self.count))
        out: double[:, ::1] = found
        counts: double[::1] = np.empty(256)
        for b in range(self.count):
            counts[:] = 0.0
            area: cython.int = 0
            skin: double = 0.0
            rim: double = 0.0
            for p in range(self.offset.shape[0]):
                if self.whose[b, p] == OWN or (self.whose[b, p] == FREE and self.rim_from <= p < self.rim_to):
                    v, u = self.middle[b, 0] + self.offset[p, 0], self.middle[b, 1] + self.offset[p, 1]
                    look = hsv[v, u, 0] | hsv[v, u, 1] << 8
                    if self.whose[b, p] == OWN:
                        counts[cell[look]] += 1.0
                        area += 1
                    else:
                        skin += is_skin[look]
                        rim += 1.0
            for i in range(256):
                if counts[i] > 0.0:
                    out[0, b] += sqrt(counts[i]) * reference[i]
            out[0, b] /= sqrt(max(area, 1))
            out[1, b] = skin / max(rim, 1.0)
        return found[0], found[1]

    def locate_centres(
        self, color: cython.const[cython.uchar][:, :, :]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Locate the centres (B, 2) and measure the areas (B,) by the share of paper in each pixel.

        The share follows from unmixing the pixel's colour, of ``color`` (H, W, 3), between the blob's core and its rim
        in the pixel's own direction: at the edge of the hand one side of a disc lies on skin and the other before the
        table. So light, tilt and half covered pixels do not pull the centre.
        """
        reach: cython.const[cython.uchar][::1] = self.stencil.reach
        direction: cython.const[cython.uchar][::1] = self.stencil.direction
        wedge: cython.const[double][:, ::1] = self.stencil.wedge
        pixels = self.offset.shape[0]
        self.check_picture(color.shape[0], color.shape[1])
        if color.shape[2] != 3:
            raise ValueError("a picture of three channels is wanted")
        if reach.shape[0] != pixels or direction.shape[0] != pixels or wedge.shape[0] != self.rim_to - self.rim_from:
            raise ValueError("a stencil's arrays are not of the sizes that belong together")
        ways = wedge.shape[1]
        for p in range(pixels):
            if direction[p] >= ways:
                raise ValueError("a stencil's directions are not of the sizes that belong together")
        offset: cython.const[cython.int][:, ::1] = self.offset
        core, rim_from, rim_to = self.core, self.rim_from, self.rim_to
        CORE, RIM, BLOB = ways, ways + 1, ways + 2
        # Red, green, blue and 1, summed over the rim in each direction, the core, all of the rim and all of the blob.
        total: double[:, ::1] = np.empty((4, ways + 3))
        unmix: double[:, ::1] = np.empty((ways, 4))
        low: double = PAPER_LOW
        high: double = PAPER_HIGH
        min_rim: double = MIN_RIM
        min_core: double = MIN_CORE
        found = np.empty((self.count, 3))
        out: double[:, ::1] = found
        for b in range(self.count):
            v0, u0 = self.middle[b, 0], self.middle[b, 1]
            whose: cython.uchar[::1] = self.whose[b]
            total[:] = 0.0
            for p in range(pixels):
                if whose[p] == OWN or (whose[p] == FREE and rim_from <= p < rim_to):
                    v, u = v0 + offset[p, 0], u0 + offset[p, 1]
                    red: double = color[v, u, 0]
                    green: double = color[v, u, 1]
                    blue: double = color[v, u, 2]
                    if whose[p] == OWN:
                        add_color(total, BLOB, red, green, blue, 1.0)
                        if p < core:
                            add_color(total, CORE, red, green, blue, 1.0)
                    else:
                        add_color(total, RIM, red, green, blue, 1.0)
                        for w in range(ways):
                            add_color(total, w, red, green, blue, wedge[p - rim_from, w])
            for w in range(ways + 1):
                if total[3, w] < (min_rim if w < ways else min_core):  # almost none there: all the rim, or all the blob
                    for k in range(4):
                        total[k, w] = total[k, RIM if w < ways else BLOB]
                for k in range(3):
                    total[k, w] /= max(total[3, w], 1.0)
            # The share of paper in a colour c is 0 for the ground's g and 1 for the paper's p, then stretched from
            # low..high to 0..1: (p - g) (c - g) / |p - g|^2, for each direction as four factors of c and 1.
            for w in range(ways):
                square: double = 0.0
                on_ground: double = 0.0
                for k in range(3):
                    unmix[w, k] = total[k, CORE] - total[k, w]
                    square += unmix[w, k] * unmix[w, k]
                for k in range(3):
                    unmix[w, k] /= (high - low) * max(square, 1.0)
                    on_ground += unmix[w, k] * total[k, w]
                unmix[w, 3] = -low / (high - low) - on_ground
            sum_1: double = 0.0
            sum_u: double = 0.0
            sum_v: double = 0.0
            for p in range(pixels):
                if whose[p] == OWN or (whose[p] == FREE and reach[p]):
                    v, u, w = v0 + offset[p, 0], u0 + offset[p, 1], direction[p]
                    share: double = color[v, u, 0] * unmix[w, 0] + color[v, u, 1] * unmix[w, 1]
                    share = min(max(share + color[v, u, 2] * unmix[w, 2] + unmix[w, 3], 0.0), 1.0)
                    sum_1 += share
                    sum_u += share * offset[p, 1]
                    sum_v += share * offset[p, 0]
            out[b, 2] = max(sum_1, 1e-9)
            out[b, 0], out[b, 1] = u0 + sum_u / out[b, 2], v0 + sum_v / out[b, 2]
        return found[:, :2], found[:, 2]

    def read_depths(
        self, depth_raw: cython.const[cython.ushort][:, :], unit_m: double, sensor: Any
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Read depths (B,) and their standard deviations (B,) in metres from the cores, NaN where not trusted.

        The median of the readings of ``depth_raw`` (H, W), 0 for none, then the mean of those near it.
        """
        near: cython.int = self.stencil.near.stop
        self.check_picture(depth_raw.shape[0], depth_raw.shape[1])
        if not self.core <= near <= self.offset.shape[0]:
            raise ValueError("a stencil's parts are not within its window")
        valid_share: double = DEPTH_VALID_SHARE
        min_readings: double = MIN_READINGS
        max_iqr: double = DEPTH_IQR_M
        edge_step: double = EDGE_STEP_M
        edge_sd: double = EDGE_SD_M
        slope_share: double = SLOPE_SHARE
        fixed_m: double = sensor.reading.fixed_m
        square_per_m: double = sensor.reading.square_per_m
        patch_px: double = sensor.patch_px
        averages: cython.bint = sensor.averages
        metres: double[::1] = np.empty(near)
        ordered: double[::1] = np.empty(self.core)
        found = np.empty((2, self.count))
        out: double[:, ::1] = found
        out[:] = NAN
        for b in range(self.count):
            own: cython.int = 0
            valid: cython.int = 0
            for p in range(near):  # off the picture a window repeats its border
                v = min(max(self.middle[b, 0] + self.offset[p, 0], 0), self.height - 1)
                u = min(max(self.middle[b, 1] + self.offset[p, 1], 0), self.width - 1)
                metres[p] = depth_raw[v, u] * unit_m
                if p < self.core and self.whose[b, p] == OWN:
                    own += 1
                    if metres[p] > 0.0:
                        insert(ordered, valid, metres[p])
                        valid += 1
            if valid == 0 or valid < max(valid_share * own, min_readings):
                continue
            median = ordered[2 * (valid - 1) >> 2]
            iqr = ordered[3 * (valid - 1) >> 2] - ordered[(valid - 1) >> 2]
            if not iqr <= max_iqr:
                continue
            close: cython.int = 0
            other: cython.int = 0
            z: double = 0.0
            for p in range(self.core):
                if self.whose[b, p] == OWN and metres[p] > 0.0 and fabs(metres[p] - median) <= max_iqr:
                    z += metres[p]
                    close += 1
            z /= max(close, 1)
            # The sensor matches small windows: near an edge of the surface they hold two, and the depth is of neither.
            for p in range(near):
                other += fabs(metres[p] - z) > edge_step
            edge = edge_sd / near * other
            slope = slope_share / 1.35 * iqr
            sd = fixed_m + square_per_m * z * z
            if averages:
                sd /= sqrt(max(close / (patch_px * patch_px), 1.0))
            out[0, b], out[1, b] = z, sqrt(sd * sd + slope * slope + edge * edge)
        return found[0], found[1]

    @cython.cfunc
    def check_picture(self, height: Py_ssize_t, width: Py_ssize_t) -> cython.bint:
        """Refuse a picture of another size than the labels."""
        if height != self.height or width != self.width:
            raise ValueError("a picture is not of the size of its labels")
        return True


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def add_color(
    total: double[:, ::1],
    column: Py_ssize_t,
    red: double,
    green: double,
    blue: double,
    weight: double,
) -> cython.void:
    """Add a colour and 1, ``weight`` times, to a column of ``total`` (4, N)."""
    total[0, column] += weight * red
    total[1, column] += weight * green
    total[2, column] += weight * blue
    total[3, column] += weight


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def insert(ordered: double[::1], count: cython.int, number: double) -> cython.void:
    """Put a number at its place among the first ``count``, which are in order."""
    while count > 0 and ordered[count - 1] > number:
        ordered[count] = ordered[count - 1]
        count -= 1
    ordered[count] = number
