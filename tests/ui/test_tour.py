"""Which bubble is shown when, without a window; and that it takes room beside what it speaks of, over nothing."""

from __future__ import annotations

from typing import get_args

from carpus.ui.kit.theme import Theme
from carpus.ui.screens.tour.bubble import (
    PARTS,
    PLACES,
    Bubble,
    BubbleView,
    TourState,
    bubble_words,
    find_bubble,
)

BUBBLES: tuple[Bubble, ...] = get_args(Bubble)
SESSION = (
    TourState("patients"),
    TourState("camera", is_busy=True),
    TourState("markers", label_stage="aiming"),
    TourState("markers", label_stage="clicking"),
    TourState("markers", label_stage="doubtful"),
    TourState("markers", label_stage="checked"),
    TourState("live"),
    TourState("live", is_recording=True),
    TourState("live", is_busy=True),
    TourState("review", is_busy=True),
    TourState("review"),
    TourState("report"),
    TourState("report", is_saved=True),
)
"""The moments that a person comes by, from the patient to the report."""


def test_session_comes_by_bubbles_in_their_order() -> None:
    shown = [find_bubble(moment) for moment in SESSION]
    assert shown == [
        "patient", None, "aim", "click", None, "check", "record", "stop", None, None, "results", "save", "end",
    ]  # fmt: skip
    assert find_bubble(TourState("review"), frozenset({"results"})) == "report"
    places = [PARTS.index(PLACES[bubble]) for bubble in shown if bubble is not None]
    assert places == sorted(places)


def test_tour_buttons_stay_and_take_no_key_during_recording(theme: Theme) -> None:
    view = BubbleView(theme, wide=True, keys=False)
    for bubble in BUBBLES:
        view.show_bubble(bubble)
        assert not view.isHidden()
        assert view.accessibleName() == bubble_words(bubble)
        assert view.has_pointer is (bubble not in ("click", "results", "end")), bubble
    view.show_bubble(None)
    assert view.isHidden()
    for button in (view.next_button, view.leave_button):
        assert not button.focusPolicy().value, "the space bar stays with the screen"
