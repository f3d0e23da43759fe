"""Sessions that are measured now: where they go, how they come into the store, what the last one said of the hand."""

from __future__ import annotations

from contextlib import suppress
from datetime import datetime
from pathlib import Path

import numpy as np

from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.core.durable import make_private
from carpus.core.errors import CarpusFault, FolderMissing, OutputNotWritable, RecordingMoved, SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.records.coming_home import fallback_place
from carpus.core.records.interrupted import recover
from carpus.core.records.kept_sets import keep_set_up
from carpus.core.records.library import Library
from carpus.core.records.session_list import free_path
from carpus.core.records.set_up import SetUp
from carpus.core.records.values import entry_of
from carpus.core.results.progress import NAMES_DOUBTED
from carpus.core.session.reader import read_outline, read_session


class NewSessions:
    """The places of a data folder for sessions that are measured; see
    :class:`core.pipeline.measuring.SessionPlaces`."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def new_path(self, set_up: SetUp) -> Path:
        """A free path for a session that begins now: on this computer while a share is away, which is told."""
        library = self._library
        about = set_up.pseudonym, set_up.exercise.id, set_up.side, datetime.now().astimezone()
        try:
            return library.index.new_path(set_up.patient_id, *about)
        except (FolderMissing, OutputNotWritable) as fault:
            if not library.store.on_share:
                raise
            path = free_path(self.fallback_folder(set_up.patient_id), *about)
            library.log_fault(RecordingMoved(path, fault.detail or phrase("not there now")))
            return path

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Take a finished session into the store, and remember how it was set up."""
        library = self._library
        if path.is_relative_to(fallback_place(library.folder)):  # the store is where the data folder is: gone
            entry = entry_of(path, read_outline(path))
            library.elsewhere[entry.session_id] = entry
            return entry.session_id
        keep_set_up(library.store, set_up)
        session_id = library.index.enter(path, set_up.patient_id, library.who()).session_id
        library.notes.session("recorded", session_id)
        return session_id

    def fallback_folder(self, patient_id: str) -> Path:
        """Where a patient's recording goes on when the data folder goes away."""
        folder = fallback_place(self._library.folder) / patient_id
        make_private(folder)
        return folder

    def last_hand_length_mm(self, set_up: SetUp, *, simulated: bool) -> float:
        """Length of this hand of the patient as the last session of the kind measured it; NaN before the first."""
        for entry in self._library.sessions(set_up.patient_id):
            if entry.hand != set_up.side:
                continue
            with suppress(SessionUnreadable):
                session = read_session(entry.path)
                verdict = session.calibration.verdict
                # Another length that was accepted is the hand's from now on; only wrong names measured no hand.
                doubted = any(
                    finding.kind in NAMES_DOUBTED for finding in verdict.findings if finding.kind != "other_length"
                )
                if session.header.simulated == simulated and not doubted and np.isfinite(verdict.hand_length_mm):
                    return verdict.hand_length_mm
        return float("nan")

    def last_straight_fingers(self, set_up: SetUp) -> tuple[bool, ...]:
        """What the last session with these discs said of the hand's fingers, thumb to little; straight before one."""
        if set_up.protocol.has_fingers:
            for entry in self._library.sessions_alike(set_up.patient_id, set_up):
                with suppress(SessionUnreadable):
                    return read_session(entry.path).calibration.straight_fingers
        return ALL_STRAIGHT

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        with suppress(CarpusFault):
            recover(self._library)
