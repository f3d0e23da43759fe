"""Pictures of stored sessions: in the session file, or in a raw recording beside it."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.files.raw import RawRecording
from carpus.core.capture.files.raw_pictures import decode_color
from carpus.core.session.reader import has_raw, read_raw_color, read_session
from carpus.core.types import ByteImage

KEPT_PICTURES = 2
"""Files of pictures that stay open: two sessions are looked at beside each other."""


class ShownPictures:
    """Pictures of the sessions looked at last. May be used from several threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: list[KeptPictures] = []

    def picture(self, paths: Sequence[Path], row: int) -> ByteImage | None:
        """The colour picture of a row of the first of these results of one recording that has pictures."""
        with_pictures = (path for path in paths if path.with_suffix(RAW_SUFFIX).exists() or has_raw(path))
        path = next(with_pictures, paths[0])
        with self._lock:
            kept = next((one for one in self._open if one.path == path), None)
            if kept is None:
                kept = KeptPictures(path)
                self._open = [kept, *self._open][:KEPT_PICTURES]
            return kept.color(row)

    def forget(self) -> None:
        """Let go of the files whose pictures were shown last."""
        with self._lock:
            self._open = []


class KeptPictures:
    """Pictures kept in a session file, or in a raw recording beside it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        raw = path.with_suffix(RAW_SUFFIX)
        self._beside = RawRecording(raw) if raw.exists() else None
        self._inside = self._beside is None and has_raw(path)
        self._times_s = read_session(path).timestamp_s if self._beside is not None else np.empty(0)

    def color(self, row: int) -> ByteImage | None:
        """The colour picture of a row, None when it was not kept."""
        if self._beside is not None:
            return self._beside.color_at(float(self._times_s[row]))
        data = read_raw_color(self.path, row) if self._inside else b""
        return decode_color(data) if data else None
