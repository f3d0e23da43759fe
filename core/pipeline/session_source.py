"""The pictures that a session kept, as a source of frames."""

from __future__ import annotations

from collections.abc import Iterator

from carpus.core.capture.files.raw_pictures import decode_color, decode_depth
from carpus.core.capture.source import SourceInfo
from carpus.core.errors import PictureDamaged
from carpus.core.phrase import phrase
from carpus.core.session.reader import raw_depth_unit_m, read_raw
from carpus.core.session.values import Session
from carpus.core.types import SIMULATED, Frame


class SessionPictures:
    """A :class:`core.capture.source.FrameSource` over the stored pictures of a session, times as in the session."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._unit_m = raw_depth_unit_m(session.path)
        self.info = SourceInfo(
            name=session.header.session_id,
            camera=session.camera,
            has_depth=True,
            frame_count=len(session),
            nominal_fps=30.0,
            settings={"format": "session"} | ({SIMULATED: "yes"} if session.header.simulated else {}),
            recording_id=session.header.recording_id,
            recorded=session.header.recorded,
        )

    def frames(self) -> Iterator[Frame]:
        """The frames in order; raises :class:`PictureDamaged` for one that cannot be decoded."""
        session = self._session
        for row, kept in enumerate(read_raw(session.path)):
            color = decode_color(kept.color)
            if color is None:
                raise PictureDamaged(session.path, phrase("colour picture {row}", row=row))
            depth = decode_depth(kept.depth) if kept.depth else None
            time_s, dropped = float(session.timestamp_s[row]), int(session.quality.dropped_before[row])
            yield Frame(row, time_s, color, depth, self._unit_m, max(dropped, 0))

    def close(self) -> None:
        """Nothing is held open between two walks."""
