"""What is recalled of the whole hand before the next session: totals on the card, the markers of the same hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from carpus.core.model.hand.exercises import get_exercise
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.session_setup import MARKERS_SUFFIX
from carpus.core.records.values import Patient
from carpus.core.results.session_results import compute_session_results
from carpus.ui.screens.patients.patient_store import _compare_results
from tests.app.test_library import set_up, store
from tests.ui.hand_fakes import FakeHandSessions


def test_patient_card_has_finger_totals_changes_and_lower_bounds() -> None:
    sessions = FakeHandSessions(pictures=False)
    first, last = (compute_session_results(sessions.session(key)) for key in ("hand-3", "hand-7"))
    lines = _compare_results(first, last)
    assert [line.subject for line, _ in lines] == [f"TAM{k}" for k in (2, 3, 4, 5)]
    assert all(line is last.find(line.subject, "arc") for line, _ in lines)
    assert any(line.is_lower_bound for line, _ in lines)
    assert any(change.verdict == "improved" for _, change in lines)


def test_last_marker_positions_are_of_the_same_hand_and_protocol(tmp_path: Path) -> None:
    library = DataFolder(tmp_path / "data")
    try:
        linden = library.patients.add(Patient("Linden 42", "right", "right"))
        wanted = set_up(linden, "Linden 42")
        path = library.entry(store(library, wanted)).path
        cv2.imwrite(str(path.with_suffix(MARKERS_SUFFIX)), np.full((40, 60, 3), 90, np.uint8))
        assert library.read_marker_photo(linden, wanted) is not None
        assert library.read_marker_photo(linden) is not None
        assert library.read_marker_photo(linden, replace(wanted, side="left")) is None
        whole_hand = replace(wanted, exercise=get_exercise("FIST_COMPOSITE"))
        assert library.read_marker_photo(linden, whole_hand) is None
        assert library.matching_sessions(linden, replace(wanted, exercise=get_exercise("WRIST_FE")))
    finally:
        library.close()
