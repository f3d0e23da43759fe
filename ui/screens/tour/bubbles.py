"""Which bubble belongs to which moment of a session: pure, so that its order can be tried without a window."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from carpus.ui.kit.translate import tr

Bubble = Literal["patient", "camera", "aim", "click", "check", "record", "stop", "results", "report", "save", "end"]
LabelStage = Literal["aiming", "clicking", "checked", "doubtful"]
"""How far the markers are: no picture is taken yet, some have no name, all are found good, something is wrong."""

PLACES: Mapping[Bubble, str] = {
    "patient": "patients", "camera": "camera", "aim": "markers", "click": "markers",
    "check": "markers", "record": "live", "stop": "live", "results": "review", "report": "review", "save": "report",
    "end": "report",
}  # fmt: skip
"""The screen of each bubble, in the order in which a session comes by them."""
PARTS = ("patients", "markers", "live", "review", "report")
"""The way as it is counted: who is measured on what is set up once, and mostly passed over."""
ONLY_READ: tuple[Bubble, ...] = ("click", "results")
"""Bubbles whose “Next” presses nothing: only a person can do it, or there is nothing to do."""
WITHOUT_POINTER: tuple[Bubble, ...] = (*ONLY_READ, "end")
"""Bubbles that speak of something else than the control below them, and so do not point at it."""


@dataclass(frozen=True, slots=True)
class TourState:
    """What decides. ``is_wanted``: the practice patient is open, or somebody asked to be shown around;
    ``is_covered``: a
    message or a sheet lies over the screen; ``is_busy``: what was begun here is still under way."""

    place: str
    is_wanted: bool = True
    is_covered: bool = False
    is_busy: bool = False
    label_stage: LabelStage = "aiming"
    is_recording: bool = False
    is_saved: bool = False


def find_bubble(state: TourState, read: frozenset[Bubble] = frozenset()) -> Bubble | None:
    """The bubble to show, None for none: what was read is not shown again."""
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
    """Which part of the way a bubble is in, from 1; 0 for what is set up in between."""
    place = PLACES[bubble]
    return PARTS.index(place) + 1 if place in PARTS else 0


def bubble_words(bubble: Bubble) -> str:
    """One sentence."""
    words: Mapping[Bubble, str] = {
        "patient": tr("Choose in the list who is measured and start here; the practice patient is simulated."),
        "camera": tr("Choose where the pictures come from, then go on here."),
        "aim": tr("Take the picture when the hand lies flat and every disc is to be seen."),
        "click": tr(
            "Look whether every name is on its disc, then press Enter; click the discs that are asked for above."
        ),
        "check": tr("Every disc has its name and every check is good: start here."),
        "record": tr("The joints are followed already; the space bar starts the recording."),
        "stop": tr("Let the hand move a few times; the space bar then stores it all."),
        "results": tr("These are the results; the key X leaves out the repetition you are at."),
        "report": tr("Make the report of this session here."),
        "save": tr("Save the report as a PDF; only the made-up name is on it."),
        "end": tr("That was a whole session; the arrow at the top left leads back, at last to the patients."),
    }
    return words[bubble]
