"""The bubbles of the guided session and when each is shown, without any window."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from carpus.ui.kit.translate import tr

Bubble = Literal["patient", "camera", "aim", "click", "check", "record", "stop", "results", "report", "save", "end"]
LabelStage = Literal["aiming", "clicking", "checked", "doubtful"]
"""Labelling: no frame yet, labels missing, all checks good, something uncertain."""

PLACES: Mapping[Bubble, str] = {
    "patient": "patients", "camera": "camera", "aim": "markers", "click": "markers",
    "check": "markers", "record": "live", "stop": "live", "results": "review", "report": "review", "save": "report",
    "end": "report",
}  # fmt: skip
"""Screen of each bubble, in the order of a session."""
PARTS = ("patients", "markers", "live", "review", "report")
"""Screens that are counted as parts of the session."""
ONLY_READ: tuple[Bubble, ...] = ("click", "results")
"""Bubbles whose “Next” presses nothing."""
WITHOUT_POINTER: tuple[Bubble, ...] = (*ONLY_READ, "end")
"""Bubbles that are not about the control below them."""


@dataclass(frozen=True, slots=True)
class TourState:
    """What decides on the bubble.

    ``is_wanted``: the practice patient is open, or the tour was requested; ``is_covered``: a message or dialog is
    open; ``is_busy``: something is still running.
    """

    place: str
    is_wanted: bool = True
    is_covered: bool = False
    is_busy: bool = False
    label_stage: LabelStage = "aiming"
    is_recording: bool = False
    is_saved: bool = False


def find_bubble(state: TourState, read: frozenset[Bubble] = frozenset()) -> Bubble | None:
    """Return the bubble to show; read bubbles are not shown again."""
    if state.is_covered or state.is_busy or not state.is_wanted:
        return None
    return next((bubble for bubble in _candidate_bubbles(state) if bubble not in read), None)


def _candidate_bubbles(state: TourState) -> tuple[Bubble, ...]:
    if state.place == "markers":
        at_work: Mapping[LabelStage, tuple[Bubble, ...]] = {
            "aiming": ("aim",),
            "clicking": ("click",),
            "checked": ("check",),
        }
        return at_work.get(state.label_stage, ())  # the screen itself says what is wrong
    if state.place == "live":
        return ("stop",) if state.is_recording else ("record",)
    if state.place == "report":
        return ("end",) if state.is_saved else ("save",)
    return tuple(bubble for bubble, place in PLACES.items() if place == state.place)


def part_number(bubble: Bubble) -> int:
    """Return the part of the session from 1 on; 0 for the set-up."""
    place = PLACES[bubble]
    return PARTS.index(place) + 1 if place in PARTS else 0


def bubble_words(bubble: Bubble) -> str:
    """Return the sentence of a bubble."""
    words: Mapping[Bubble, str] = {
        "patient": tr("Choose a patient in the list, then start here. The practice patient is simulated."),
        "camera": tr("Choose the image source, then continue here."),
        "aim": tr("Take the image when the hand lies flat and every marker is visible."),
        "click": tr("Check that every label is on its marker, then press Enter."),
        "check": tr("Every marker has its label and all checks are good. Start measuring here."),
        "record": tr("The joints are already tracked. The space bar starts the recording."),
        "stop": tr("Let the hand move a few times. Then press the space bar to stop and save."),
        "results": tr("These are the results. The key X excludes the current repetition."),
        "report": tr("Make the report of this session here."),
        "save": tr("Save the report as a PDF. It contains only the pseudonym."),
        "end": tr("You have finished a whole session. The arrow at the top left leads back to the patients."),
    }
    return words[bubble]
