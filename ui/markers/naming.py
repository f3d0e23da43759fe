"""The names on a hand's discs and the calibration that they give: the work of the screen without the screen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
from PySide6.QtCore import QObject, Signal

from carpus.core.calibration.result import Verdict
from carpus.core.types import FloatArray, Frame
from carpus.ui.background import Background
from carpus.ui.controls.button import ENTER
from carpus.ui.markers.clicking import Clicking
from carpus.ui.ports import Calibrator, Judged, ProposedMarker
from carpus.ui.tour.order import Work
from carpus.ui.translate import tr


class Naming(QObject):
    """On a live picture first, then on one that is held. ``edited`` when names are others, so that an old verdict
    counts no longer; ``changed`` when something else is to be shown; ``doubted`` carries a disc to be looked at.

    ``started`` when tracking has begun; ``judged`` carries each verdict; ``told`` a fault.
    """

    edited = Signal()
    changed = Signal()
    doubted = Signal(object)
    started = Signal()
    judged = Signal(object)
    told = Signal(object)

    def __init__(self, background: Background) -> None:
        super().__init__()
        self._background = background
        self.calibrator: Calibrator | None = None
        self.clicking: Clicking | None = None
        self.outcome: Judged | None = None
        """Of the names as they are; None before."""
        self.start_angles_rad = np.zeros(3)
        self.waits = False
        """Whether the program still looks for names."""
        self._by_hand = self._goes_on = False
        self._proposing = self._judging = 0

    def begin(self, calibrator: Calibrator) -> None:
        self.calibrator, self.start_angles_rad = calibrator, np.zeros(3)
        self.aim()

    def aim(self) -> None:
        """On a live picture: nothing has a name, and what is still worked out of the last one counts no more."""
        self.clicking = self.outcome = None
        self._judging += 1
        self._proposing += 1
        self.waits = False

    def hold(self) -> Frame:
        """Fix the picture; the program proposes names."""
        assert self.calibrator is not None
        calibrator = self.calibrator
        frame = calibrator.hold()
        straight = calibrator.last_straight_fingers
        self.clicking = Clicking(calibrator.protocol, calibrator.side, straight_fingers=straight)
        self.outcome, self._by_hand = None, False
        return frame

    @property
    def work(self) -> Work:
        if self.clicking is None:
            return "aiming"
        if self.outcome is None:
            return "clicking"
        return "checked" if self.outcome.verdict.is_good else "doubtful"

    # --- names --------------------------------------------------------------------------------------------
    def click(self, pixel: FloatArray) -> str | None:
        """Put the current name on the disc at a place; None where that was done, else the name that the disc has
        already, empty where there is no disc."""
        assert self.clicking is not None
        assert self.calibrator is not None
        found = self.calibrator.marker_at(pixel)
        if found is None:
            return ""
        if taken := self.clicking.taken_by(found.pixel):
            return taken
        agreed = self.clicking.confirms(found.pixel)
        swapped = self.clicking.place(found.pixel, found.width_px)
        if not agreed and not swapped:
            self.ask_for_names()  # of two that changed places the person has said all there is to say
        self.edit()
        return None

    def ask_for_names(self) -> None:
        """Let the program propose the names no person has given; each click of a person is one more thing it knows."""
        self._proposing += 1
        self.waits = False
        if self._by_hand or self.clicking is None or self.calibrator is None or self.clicking.complete:
            return
        number, calibrator, named = self._proposing, self.calibrator, dict(self.clicking.pixel)
        self.waits = True

        def take(proposed: Mapping[str, ProposedMarker]) -> None:
            if number != self._proposing or self.clicking is None:
                return
            self.waits = False
            if set(self.clicking.pixel) != set(named):
                self.ask_for_names()  # clicked meanwhile
                return
            self.clicking.propose(proposed)
            self._look_at_doubtful()
            self.changed.emit()

        judging = self._judging
        self._background.run(
            lambda: calibrator.propose(named), take, lambda fault: self._take_fault(judging, fault), self
        )

    def _look_at_doubtful(self) -> None:
        """The first doubtful disc comes into the loupe, to be confirmed or changed."""
        clicking = self.clicking
        if clicking is not None and clicking.doubtful:
            clicking.current = clicking.doubtful[0]
            self.doubted.emit(clicking.proposed[clicking.current].pixel)

    def take_all(self, *, goes_on: bool = False) -> None:
        """Confirm all names that are proposed. ``goes_on``: with all checks good and nothing to ask it measures."""
        if self.clicking is not None and self.clicking.proposed:
            self.clicking.take_all()
            self.edit(goes_on=goes_on)

    def confirm_doubtful(self) -> None:
        """The doubtful name in the loupe is right; the next one comes into it."""
        assert self.clicking is not None
        self.clicking.confirm(self.clicking.doubtful[0])
        self._look_at_doubtful()
        self.edit()

    def click_by_hand(self) -> None:
        """No more proposals: every marker is clicked by the person."""
        self._by_hand = True
        self._proposing += 1
        self.waits = False
        if self.clicking is not None:
            self.clicking.propose({})
            self.edit()

    def undo(self) -> None:
        if self.clicking is not None and self.clicking.undo():
            self.ask_for_names()
            self.edit()

    def say_straight(self, answer: tuple[bool, ...]) -> None:
        if self.clicking is not None and self.clicking.straight_fingers != answer:
            self.clicking.straight_fingers = answer
            self.edit()

    # --- the verdict --------------------------------------------------------------------------------------
    def edit(self, *, goes_on: bool = False) -> None:
        """Names are different: the old verdict no longer counts, a new one is asked for when all are there."""
        self.outcome, self._goes_on = None, goes_on
        self._judging += 1
        self.edited.emit()
        calibrator, number = self.calibrator, self._judging
        if self.clicking is None or not self.clicking.complete or calibrator is None:
            self.changed.emit()
            return
        clicks, angles = self.clicking.clicks(), self.start_angles_rad

        def take(outcome: Judged) -> None:
            if number != self._judging:
                return
            self.outcome = outcome
            self.changed.emit()
            self.judged.emit(outcome.verdict)
            asks = calibrator.protocol.has_fingers  # which of them lie straight
            if self._goes_on and outcome.verdict.is_good and not asks:  # nothing is left to decide
                self.start()

        self._background.run(
            lambda: calibrator.judge(clicks, angles), take, lambda fault: self._take_fault(number, fault), self
        )
        self.changed.emit()

    def _take_fault(self, number: int, fault: Exception) -> None:
        if number == self._judging:
            self.told.emit(fault)

    def start(self) -> None:
        if self.outcome is not None and self.outcome.calibration is not None and self.calibrator is not None:
            self.calibrator.begin(self.outcome.calibration)
            self.started.emit()

    def remedy(self) -> Remedy:
        assert self.outcome is not None
        assert self.calibrator is not None
        return remedy_of(self.outcome.verdict, is_live=self.calibrator.is_live)

    def swap(self) -> None:
        """Names that stand in for each other change places."""
        pairs = exchanged(self.outcome.verdict) if self.outcome is not None else []
        if pairs and self.clicking is not None:
            pixel = self.clicking.pixel
            for one, other in pairs:
                pixel[one], pixel[other] = pixel[other], pixel[one]
            self.edit()

    def click_again(self) -> None:
        """Take back the markers at fault, or all of them where the fault lies with none."""
        if self.clicking is None or self.outcome is None:
            if self.clicking is not None and self.clicking.proposed:
                self.click_by_hand()
            return
        self.clicking.clear(at_fault(self.outcome.verdict))
        self.edit()

    def take_spot(self) -> None:
        """The spot in question is the disc: the name moves to it."""
        for finding in self.outcome.verdict.findings if self.outcome is not None else ():
            if finding.spot_px and finding.markers and self.clicking is not None:
                (name,) = finding.markers
                self.clicking.pixel[name] = np.array(finding.spot_px)
        self.edit()


Remedy = Literal["swap", "click_these", "correct", "take_spot", "new_picture"]

_PICTURE = ("tilt", "distance", "moved", "few_frames", "depth_off")
"""Causes that lie with hand, camera or light, never with the names."""


def remedy_of(verdict: Verdict, *, is_live: bool) -> Remedy:
    """The likeliest way out, that of wrong names before that of a bad picture."""
    kinds = {finding.kind for finding in verdict.findings}
    if "swapped" in kinds:
        return "swap"
    if "shifted" in kinds or any(finding.blocks and finding.markers for finding in verdict.findings):
        return "click_these"
    if kinds & {"wrong_side", "misnamed"}:
        return "correct"
    if "other_spot" in kinds:
        return "take_spot"
    if kinds & {"no_palm", "near_spot"}:
        return "click_these"
    if is_live and kinds & set(_PICTURE):
        return "new_picture"
    if kinds & {"residual", "no_depth"}:
        return "click_these"
    return "correct"


def exchanged(verdict: Verdict) -> list[tuple[str, str]]:
    """Names that stand in for each other: two, or those of two fingers each for each."""
    names = next((finding.markers for finding in verdict.findings if finding.kind == "swapped"), ())
    half = len(names) // 2
    return list(zip(names[:half], names[half:], strict=True))


def at_fault(verdict: Verdict) -> tuple[str, ...]:
    """The markers that something is found with."""
    return tuple(dict.fromkeys(name for finding in verdict.findings for name in finding.markers))


def face(remedy: Remedy) -> tuple[str, str]:
    """Words and key of the primary button."""
    return {
        "swap": (tr("Swap the two"), ENTER),
        "click_these": (tr("Click again"), "C"),
        "correct": (tr("Correct names"), ""),
        "take_spot": (tr("Take that spot"), ""),
        "new_picture": (tr("New picture"), "N"),
    }[remedy]
