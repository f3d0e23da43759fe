"""The back of the hand over its fixed unit, as a surface: heights over a grid in W0."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from carpus.core.model.types import FloatArray


@dataclass(frozen=True, slots=True)
class DorsalSurface:
    """Height and slopes of the skin over the nodes of a grid in W0.

    ``origin_m`` (2,) x and y of the first node, ``step_m`` between nodes; ``height_m``, ``slope_x``, ``slope_y`` (H,
    W), rows along y; NaN where the surface is not known or not part of the fixed unit. ``middle_m`` (3,) of it.
    Computed once: ``plane`` (nodes, 4) of every node and of a border about the grid, and ``to_node`` (4, 2), which maps
    a place and 1 to the number of its column and row there.
    """

    origin_m: FloatArray
    step_m: float
    height_m: FloatArray
    slope_x: FloatArray
    slope_y: FloatArray
    middle_m: FloatArray

    plane: FloatArray = field(init=False, repr=False, compare=False)
    to_node: FloatArray = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        rows, columns = self.height_m.shape
        x = self.origin_m[0] + self.step_m * np.arange(columns) - self.middle_m[0]
        y = self.origin_m[1] + self.step_m * np.arange(rows)[:, None] - self.middle_m[1]
        plane = np.zeros((rows + 2, columns + 2, 4))
        inner = plane[1:-1, 1:-1]
        inner[..., 0], inner[..., 1], inner[..., 2] = -self.slope_x, -self.slope_y, 1.0
        inner[..., 3] = self.slope_x * x + self.slope_y * y - (self.height_m - self.middle_m[2])
        inner /= np.sqrt(self.slope_x**2 + self.slope_y**2 + 1.0)[..., None]
        plane[~(plane[..., 2] > 0.0)] = _FAR_PLANE
        to_node = np.zeros((4, 2))
        to_node[0, 0] = to_node[1, 1] = 1.0 / self.step_m
        to_node[3] = (self.middle_m[:2] - self.origin_m) / self.step_m + 1.0
        object.__setattr__(self, "plane", plane.reshape(-1, 4))
        object.__setattr__(self, "to_node", to_node)

    def node_positions_m(self) -> FloatArray:
        """Return the known nodes (N, 3) in W0."""
        row, column = np.nonzero(np.isfinite(self.height_m))
        across = self.origin_m + self.step_m * np.column_stack((column, row))
        return np.column_stack((across, self.height_m[row, column]))

    def to_table(self) -> FloatArray:
        """Return the surface as rows (``TABLE_ROWS``, 5), NaN below.

        First origin x, y, step, rows and columns of the grid, then the middle, then every known node as row, column,
        height and slopes.
        """
        row, column = np.nonzero(np.isfinite(self.height_m))
        table = np.full((TABLE_ROWS, 5), np.nan)
        table[0] = (*self.origin_m, self.step_m, *self.height_m.shape)
        table[1, :3] = self.middle_m
        is_known = self.height_m[row, column], self.slope_x[row, column], self.slope_y[row, column]
        table[2 : 2 + row.size] = np.column_stack((row, column, *is_known))
        return table

    @staticmethod
    def from_table(table: FloatArray) -> DorsalSurface | None:
        """Return the surface in a table; None where nothing is known or the rows are no surface."""
        if not np.isfinite(table[0]).all() or not np.isfinite(table[1, :3]).all():
            return None
        rows, columns = int(table[0, 3]), int(table[0, 4])
        node = table[2:][np.isfinite(table[2:]).all(axis=1)]
        row, column = node[:, 0].astype(np.int64), node[:, 1].astype(np.int64)
        if not (0 < rows <= TABLE_ROWS and 0 < columns <= TABLE_ROWS and table[0, 2] > 0.0 and len(node)):
            return None
        if row.min() < 0 or column.min() < 0 or row.max() >= rows or column.max() >= columns:
            return None
        grid = np.full((3, rows, columns), np.nan)
        grid[:, row, column] = node[:, 2:].T
        return DorsalSurface(table[0, :2].copy(), float(table[0, 2]), grid[0], grid[1], grid[2], table[1, :3].copy())


_FAR_PLANE = np.array([0.0, 0.0, 0.0, 1e3])  # a plane that no place is near
TABLE_ROWS = 1024  # of a surface as a table: twice what the largest hand has

STEP_M = 0.002  # between the nodes of the surface
OUTLINE_SCALE = 1.12  # the area is so many times the outline of the discs that span it
KERNEL_RADIUS_M = 0.004  # how far from a node a reading has weight
MIN_WEIGHT = 0.05  # a node with less weight of readings is unknown
MIN_POINTS = 12  # a node with fewer readings is unknown
MAX_HEIGHT_M = 0.020  # readings farther from the plane of the discs are of something else
MIN_NODES = 60  # with fewer known nodes there is no surface


def fit_dorsal_surface(point_m: FloatArray, outline_m: FloatArray) -> DorsalSurface | None:
    """Fit the surface through points on the back of the hand.

    Each node's plane is fitted to the points about it, weighted by distance.

    Parameters
    ----------
    point_m : (P, 3)
        Depth readings in W0.
    outline_m : (4, 3)
        Discs WRIST, CMC1, MCP2, MCP3; the surface is fitted within them, a little widened.

    Returns
    -------
    DorsalSurface or None
        None where too little of it was seen.
    """
    middle = outline_m.mean(axis=0)
    outline = middle[:2] + OUTLINE_SCALE * (outline_m[:, :2] - middle[:2])
    outline = outline[np.argsort(np.arctan2(*(outline - middle[:2]).T[::-1]))]
    low, high = outline.min(axis=0), outline.max(axis=0)
    level = np.median(outline_m[:, 2])
    is_near = (point_m[:, :2] > low - KERNEL_RADIUS_M).all(axis=1) & (point_m[:, :2] < high + KERNEL_RADIUS_M).all(
        axis=1
    )
    point = point_m[is_near & (np.abs(point_m[:, 2] - level) < MAX_HEIGHT_M)]
    columns, rows = (np.ceil((high - low) / STEP_M).astype(int) + 1).tolist()
    grid = low + STEP_M * np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1)  # (H, W, 2)
    found = np.full((rows, columns, 3), np.nan)
    is_inside = np.ones((rows, columns), dtype=bool)
    for a, b in zip(outline, np.roll(outline, -1, axis=0), strict=True):  # convex, counter-clockwise
        edge, to_node = b - a, grid - a
        is_inside &= edge[0] * to_node[..., 1] - edge[1] * to_node[..., 0] >= 0.0
    for row, column in np.argwhere(is_inside):
        offset = point[:, :2] - grid[row, column]
        weight = np.exp(-0.5 * (offset * offset).sum(axis=1) / (0.5 * KERNEL_RADIUS_M) ** 2)
        weight[weight < MIN_WEIGHT] = 0.0
        if np.count_nonzero(weight) < MIN_POINTS:
            continue
        design = np.column_stack((np.ones(len(point)), offset)) * np.sqrt(weight)[:, None]
        plane, _, rank, _ = np.linalg.lstsq(design, point[:, 2] * np.sqrt(weight), rcond=None)
        if rank == 3:
            found[row, column] = plane
    is_known = np.isfinite(found[..., 0])
    if not MIN_NODES <= np.count_nonzero(is_known) <= TABLE_ROWS - 2:
        return None
    centre = np.append(grid[is_known].mean(axis=0), found[is_known][:, 0].mean())
    return DorsalSurface(low, STEP_M, found[..., 0], found[..., 1], found[..., 2], centre)
