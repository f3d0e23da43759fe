"""Marker positions of stored frames, as tracked and as corrected, with undo."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from carpus.core.model.types import FloatArray
from carpus.core.session.label_checks import Correction, predict_marker_px
from carpus.core.session.values import Session

SNAP_RADIUS_PX = 8.0
"""A position this near to a blob becomes its centre."""
MarkerPosition = tuple[float, float] | None


class MarkerEdits:
    """Corrections of one session, by row."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.markers = session.header.protocol.markers
        self._edits: dict[int, dict[str, MarkerPosition]] = {}
        self._undo_stack: list[tuple[int, dict[str, MarkerPosition]]] = []

    # --- positions --------------------------------------------------------------------------------------
    def original_px(self, row: int) -> FloatArray:
        """Return the tracked marker pixels (M, 2), NaN where not measured."""
        return np.asarray(self.session.markers.measured_px[row])

    def current_px(self, row: int) -> FloatArray:
        places = self.original_px(row).copy()
        for name, place in self._edits.get(row, {}).items():
            places[self.markers.index(name)] = np.nan if place is None else place
        return places

    def row_edits(self, row: int) -> Mapping[str, MarkerPosition]:
        return self._edits.get(row, {})

    def model_px(self, row: int) -> FloatArray:
        """Return the marker pixels (M, 2) of the hand model."""
        known = self.session.markers.position_cam_m[row]
        out = np.full((len(self.markers), 2), np.nan)
        finite = np.isfinite(known).all(axis=1)
        if finite.any():
            camera = self.session.camera
            out[finite] = camera.distort(camera.project(known[finite]))
        return out

    def residual_mm(self, row: int, name: str, *, is_original: bool = False) -> float:
        """Return the distance of a marker from where the others expect it, in mm; NaN if unknown."""
        number = self.markers.index(name)
        places = self.current_px(row)
        expected = predict_marker_px(self.session, row, places, number)
        at = self.original_px(row)[number] if is_original else places[number]
        depth_m = self.session.markers.position_cam_m[row, :, 2]
        known = depth_m[np.isfinite(depth_m)]
        if not len(known) or not np.isfinite(at).all() or not np.isfinite(expected).all():
            return math.nan
        return 1000.0 * float(np.linalg.norm(at - expected)) * float(np.median(known)) / self.session.camera.fx_px

    def find_marker(self, row: int, pixel: FloatArray, reach_px: float) -> str:
        """Return the marker near a pixel, also an occluded one of the model; empty if none."""
        places = self.current_px(row)
        places = np.where(np.isfinite(places), places, self.model_px(row))
        distance = np.linalg.norm(places - pixel, axis=1)
        if not np.isfinite(distance).any() or np.nanmin(distance) > reach_px:
            return ""
        return self.markers[int(np.nanargmin(distance))]

    # --- changes -------------------------------------------------------------------------------------------
    def place_marker(self, row: int, name: str, pixel: FloatArray, blob_px: FloatArray) -> None:
        """Move a marker to a pixel, snapped to a blob of ``blob_px`` (S, 2).

        A marker that is already there changes places with it.
        """
        at = np.asarray(pixel, dtype=float)
        if len(blob_px):
            distance = np.linalg.norm(blob_px - at, axis=1)
            if distance.min() <= SNAP_RADIUS_PX:
                at = blob_px[int(distance.argmin())]
        places, number = self.current_px(row), self.markers.index(name)
        taken = np.linalg.norm(places - at, axis=1)
        taken[number] = np.inf
        other = int(np.nanargmin(taken)) if np.isfinite(taken).any() else -1
        self._push_undo(row)
        row_edits = self._edits.setdefault(row, {})
        if other >= 0 and taken[other] <= SNAP_RADIUS_PX:
            old = places[number]
            row_edits[self.markers[other]] = (float(old[0]), float(old[1])) if np.isfinite(old).all() else None
        row_edits[name] = (float(at[0]), float(at[1]))

    def hide_marker(self, row: int, name: str) -> None:
        self._push_undo(row)
        self._edits.setdefault(row, {})[name] = None

    def undo(self) -> int:
        """Undo the last step; return its row, -1 if there is none."""
        if not self._undo_stack:
            return -1
        row, before = self._undo_stack.pop()
        if before:
            self._edits[row] = before
        else:
            self._edits.pop(row, None)
        return row

    def _push_undo(self, row: int) -> None:
        self._undo_stack.append((row, dict(self._edits.get(row, {}))))

    def corrections(self) -> tuple[Correction, ...]:
        return tuple(Correction(row, dict(places)) for row, places in sorted(self._edits.items()) if places)
