"""What the reports are gathered from: the hand's own sessions, and the other hand beside them."""

from __future__ import annotations

from carpus.ui.report.progress_page import build_progress_report
from carpus.ui.report.session_page import build_session_report
from tests.ui.fakes import FakeSessions


def test_session_number_counts_the_same_hand() -> None:
    store = FakeSessions()
    report = build_session_report(store.session("session-7"), history=store.history("linden"))
    assert {one.side for one in store.history("linden")} == {"left", "right"}
    assert report.session_number == 7


def test_progress_report_shows_the_other_hand() -> None:
    history = FakeSessions().history("linden")
    right, (left,) = [one for one in history if one.side == "right"], [one for one in history if one.side == "left"]
    assert build_progress_report(right).progress.other_hand is None
    assert build_progress_report(right, other_hand=left).progress.other_hand is left
    assert build_progress_report(history).progress.other_hand is left
