"""What is said of the discs of a whole hand: which are hidden, and what brings them back into view."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from carpus.core.hand.protocols import PALM_MARKERS
from carpus.core.types import TrackedFrame, TrackStatus
from carpus.ui.live.light import Lamp
from carpus.ui.marker_words import finger_name, hidden_remedy, marker_name
from carpus.ui.plot.history import Seen
from carpus.ui.translate import inside, tr

LEAST_PALM = 3
_ENDS = ("PIP", "DIP", "TIP", "IP")


def hand_lamp(frame: TrackedFrame | None, seen: Mapping[str, Seen]) -> Lamp:
    """The tracking light of the whole hand, from the same state as its map; that state does not flicker."""
    if frame is None:
        return Lamp("idle", tr("Waiting for the first picture"), "")
    if frame.status == TrackStatus.LOST:
        return Lamp("bad", tr("Hand lost"), tr("Hold the hand flat under the camera"))
    hidden = [name for name, state in seen.items() if state == "hidden"]
    partly = [name for name, state in seen.items() if state == "partly"]
    palm = sum(name in PALM_MARKERS for name in hidden)
    if len(PALM_MARKERS) - palm < LEAST_PALM or frame.status == TrackStatus.PREDICTED:
        return Lamp("warn", tr("Too few markers seen"), tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return Lamp("warn", tr("Doubtful"), tr("What is seen does not fit: hold the hand flat for a moment"))
    if not hidden and partly:
        return Lamp("warn", _partly_words(partly), remedy(partly))
    if not hidden and not np.isfinite(frame.moment.joint_angles_rad).any():
        return Lamp("idle", tr("No angle known yet"), tr("Hold the hand flat for a moment"))
    if not hidden:
        return Lamp("good", tr("Tracking well"), tr("All {count} markers seen").format(count=len(seen)))
    return Lamp("warn", hidden_words(hidden), remedy(hidden))


def hidden_words(hidden: Sequence[str]) -> str:
    """``Ring tip hidden``, ``Thumb hidden``, ``Finger ends hidden``, ``7 markers hidden``."""
    if len(hidden) == 1:
        return tr("{marker} hidden").format(marker=marker_name(hidden[0]))
    fingers = {name[-1] for name in hidden if name not in PALM_MARKERS}
    if len(fingers) == 1 and all(name not in PALM_MARKERS for name in hidden):
        (finger,) = fingers
        if finger == "1":
            return tr("Thumb hidden")
        return tr("{finger} finger hidden").format(finger=finger_name(finger))
    if all(name.rstrip("12345") in _ENDS for name in hidden):
        return tr("Finger ends hidden")
    return tr("{count} markers hidden").format(count=len(hidden))


def remedy(hidden: Sequence[str]) -> str:
    """What to do; the palm first, since without it nothing is tracked."""
    palm = [name for name in hidden if name in PALM_MARKERS]
    if len(palm) == 1:
        return hidden_remedy(palm[0])
    if palm:
        return tr("Turn the back of the hand to the camera")
    if all(name[-1] == "1" for name in hidden):
        return tr("Turn the thumb side up")
    if len(hidden) == 1 and hidden[0].startswith("TIP"):
        return tr("Raise the hand")
    return tr("Turn the back of the fingers to the camera")


def map_words(seen: Mapping[str, Seen], *, infers_ends: bool = False) -> str:
    """The sentence beside the hand map: what is hidden, and what to do, or that end joints are only inferred."""
    hidden = [name for name, state in seen.items() if state == "hidden"]
    partly = [name for name, state in seen.items() if state == "partly"]
    if not hidden and not partly:
        if infers_ends:
            return tr("All markers seen. End joints are not measured: they follow the middle joints.")
        return tr("All markers seen, every joint is measured.")
    poor = hidden or partly
    words = hidden_words(poor) if hidden else _partly_words(poor)
    sentence = tr("{what}: {remedy}.").format(what=words, remedy=_lower(remedy(poor)))
    return f"{sentence} {tr('Hidden joints do not count.')}" if hidden else sentence


def _partly_words(poor: Sequence[str]) -> str:
    if len(poor) == 1:
        return tr("{marker} seen now and then").format(marker=marker_name(poor[0]))
    return tr("{count} markers seen now and then").format(count=len(poor))


def _lower(words: str) -> str:
    return inside(words)
