"""Where the markers of stored pictures are, as tracked and as a person puts them; every step can be taken back."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from carpus.core.session.marker_doubts import Correction, NameDoubt, expected_px, name_doubt
from carpus.core.session.values import Session
from carpus.core.types import FloatArray

SNAP_PX = 8.0
"""A place this near to a blue spot is the spot's middle."""
Place = tuple[float, float] | None


class Places:
    """The corrections of one session, picture by picture."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.markers = session.header.protocol.markers
        self._changed: dict[int, dict[str, Place]] = {}
        self._undo: list[tuple[int, dict[str, Place]]] = []
        self._doubts: dict[int, tuple[dict[str, Place], NameDoubt | None]] = {}

    # --- what is there ------------------------------------------------------------------------------------
    def before(self, row: int) -> FloatArray:
        """The blobs (M, 2) that were taken for the markers; NaN for none."""
        return np.asarray(self.session.markers.measured_px[row])

    def now(self, row: int) -> FloatArray:
        places = self.before(row).copy()
        for name, place in self._changed.get(row, {}).items():
            places[self.markers.index(name)] = np.nan if place is None else place
        return places

    def changed(self, row: int) -> Mapping[str, Place]:
        return self._changed.get(row, {})

    def modelled(self, row: int) -> FloatArray:
        """Where the model has the markers (M, 2)."""
        known = self.session.markers.position_cam_m[row]
        out = np.full((len(self.markers), 2), np.nan)
        finite = np.isfinite(known).all(axis=1)
        if finite.any():
            camera = self.session.camera
            out[finite] = camera.distort(camera.project(known[finite]))
        return out

    def off_mm(self, row: int, name: str, *, as_tracked: bool = False) -> float:
        """Distance of a marker from where the others expect it; NaN where one of the two is not known."""
        number = self.markers.index(name)
        places = self.now(row)
        expected = expected_px(self.session, row, places, number)
        at = self.before(row)[number] if as_tracked else places[number]
        depth_m = self.session.markers.position_cam_m[row, :, 2]
        known = depth_m[np.isfinite(depth_m)]
        if not len(known) or not np.isfinite(at).all() or not np.isfinite(expected).all():
            return math.nan
        return 1000.0 * float(np.linalg.norm(at - expected)) * float(np.median(known)) / self.session.camera.fx_px

    def near(self, row: int, pixel: FloatArray, reach_px: float) -> str:
        """The marker at a place of the picture, also one that is hidden where the model has it; empty for none."""
        places = self.now(row)
        places = np.where(np.isfinite(places), places, self.modelled(row))
        distance = np.linalg.norm(places - pixel, axis=1)
        if not np.isfinite(distance).any() or np.nanmin(distance) > reach_px:
            return ""
        return self.markers[int(np.nanargmin(distance))]

    def doubt(self) -> tuple[int, NameDoubt] | None:
        """The first picture whose names, as a person put them, are plainly wrong, and what is; None for none."""
        for row, said in sorted(self._changed.items()):
            known = self._doubts.get(row)
            if known is None or known[0] != said:
                known = self._doubts[row] = (dict(said), name_doubt(self.session, row, self.now(row), said))
            if known[1] is not None:
                return row, known[1]
        return None

    # --- what a person says -------------------------------------------------------------------------------
    def put(self, row: int, name: str, pixel: FloatArray, spots: FloatArray) -> None:
        """A marker is here: on the middle of the spot (S, 2) under it if there is one. A name that is there already
        changes places with it."""
        at = np.asarray(pixel, dtype=float)
        if len(spots):
            distance = np.linalg.norm(spots - at, axis=1)
            if distance.min() <= SNAP_PX:
                at = spots[int(distance.argmin())]
        places, number = self.now(row), self.markers.index(name)
        taken = np.linalg.norm(places - at, axis=1)
        taken[number] = np.inf
        other = int(np.nanargmin(taken)) if np.isfinite(taken).any() else -1
        self._remember(row)
        own = self._changed.setdefault(row, {})
        if other >= 0 and taken[other] <= SNAP_PX:
            old = places[number]
            own[self.markers[other]] = (float(old[0]), float(old[1])) if np.isfinite(old).all() else None
        own[name] = (float(at[0]), float(at[1]))

    def exchange(self, row: int, one: str, other: str) -> None:
        places = self.now(row)
        self._remember(row)
        own = self._changed.setdefault(row, {})
        for name, there in ((one, other), (other, one)):
            at, before = places[self.markers.index(there)], self.before(row)[self.markers.index(name)]
            own[name] = (float(at[0]), float(at[1])) if np.isfinite(at).all() else None
            if np.array_equal(at, before, equal_nan=True):
                del own[name]  # as it was tracked
        if not own:
            del self._changed[row]

    def hide(self, row: int, name: str) -> None:
        self._remember(row)
        self._changed.setdefault(row, {})[name] = None

    def undo(self) -> int:
        """Take the last step back; the picture it was made on, -1 for none."""
        if not self._undo:
            return -1
        row, before = self._undo.pop()
        if before:
            self._changed[row] = before
        else:
            self._changed.pop(row, None)
        return row

    def _remember(self, row: int) -> None:
        self._undo.append((row, dict(self._changed.get(row, {}))))

    def corrections(self) -> tuple[Correction, ...]:
        return tuple(Correction(row, dict(places)) for row, places in sorted(self._changed.items()) if places)
