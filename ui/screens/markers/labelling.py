"""The names on a hand's discs and the calibration that they give: the work of the screen without the screen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
from PySide6.QtCore import QObject, Signal

from carpus.core.calibration.result import Verdict
from carpus.core.model.types import FloatArray, Frame
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import ENTER_KEY
from carpus.ui.kit.translate import tr
from carpus.ui.screens.markers.label_state import LabelState
from carpus.ui.screens.tour.bubbles import LabelStage
from carpus.ui.shell.view_models import CalibrationAssessment, Calibrator, LabelProposal


class LabellingController(QObject):
    """On a live picture first, then on one that is held. ``labels_changed`` when names are others, so that an old
    verdict
    counts no longer; ``view_changed`` when something else is to be shown; ``doubt_found`` carries a disc to be looked
    at.

    ``started`` when tracking has begun; ``judged`` carries each verdict; ``fault_raised`` a fault.
    """

    labels_changed = Signal()
    view_changed = Signal()
    doubt_found = Signal(object)
    started = Signal()
    judged = Signal(object)
    fault_raised = Signal(object)

    def __init__(self, background: Background) -> None:
        super().__init__()
        self._background = background
        self.calibrator: Calibrator | None = None
        self.labels: LabelState | None = None
        self.outcome: CalibrationAssessment | None = None
        """Of the names as they are; None before."""
        self.start_angles_rad = np.zeros(3)
        self.is_proposing = False
        """Whether the program still looks for names."""
        self._is_manual = self._starts_if_good = False
        self._proposing = self._judging = 0

    def open_calibrator(self, calibrator: Calibrator) -> None:
        self.calibrator, self.start_angles_rad = calibrator, np.zeros(3)
        self.reset()

    def reset(self) -> None:
        """On a live picture: nothing has a name, and what is still worked out of the last one counts no more."""
        self.labels = self.outcome = None
        self._judging += 1
        self._proposing += 1
        self.is_proposing = False

    def freeze_frame(self) -> Frame:
        """Fix the picture; the program proposes names."""
        assert self.calibrator is not None
        calibrator = self.calibrator
        frame = calibrator.freeze_frame()
        straight = calibrator.previous_straight_fingers
        self.labels = LabelState(calibrator.protocol, calibrator.side, straight_fingers=straight)
        self.outcome, self._is_manual = None, False
        return frame

    @property
    def stage(self) -> LabelStage:
        if self.labels is None:
            return "aiming"
        if self.outcome is None:
            return "clicking"
        return "checked" if self.outcome.verdict.is_good else "doubtful"

    # --- names --------------------------------------------------------------------------------------------
    def click(self, pixel: FloatArray) -> str | None:
        """Put the current name on the disc at a place; None where that was done, else the name that the disc has
        already, empty where there is no disc."""
        assert self.labels is not None
        assert self.calibrator is not None
        found = self.calibrator.find_marker(pixel)
        if found is None:
            return ""
        if taken := self.labels.find_owner(found.pixel):
            return taken
        agreed = self.labels.is_proposed_at(found.pixel)
        swapped = self.labels.set_label(found.pixel, found.width_px)
        if not agreed and not swapped:
            self.request_proposals()  # of two that changed places the person has said all there is to say
        self.request_verdict()
        return None

    def request_proposals(self) -> None:
        """Let the program propose the names no person has given; each click of a person is one more thing it knows."""
        self._proposing += 1
        self.is_proposing = False
        if self._is_manual or self.labels is None or self.calibrator is None or self.labels.is_complete:
            return
        number, calibrator, named = self._proposing, self.calibrator, dict(self.labels.confirmed_px)
        self.is_proposing = True

        def handle_proposals(proposed: Mapping[str, LabelProposal]) -> None:
            if number != self._proposing or self.labels is None:
                return
            self.is_proposing = False
            if set(self.labels.confirmed_px) != set(named):
                self.request_proposals()  # clicked meanwhile
                return
            self.labels.set_proposals(proposed)
            self._show_doubtful()
            self.view_changed.emit()

        judging = self._judging
        self._background.run(
            lambda: calibrator.propose_labels(named),
            handle_proposals,
            lambda fault: self._raise_fault(judging, fault),
            self,
        )

    def _show_doubtful(self) -> None:
        """The first doubtful disc comes into the loupe, to be confirmed or changed."""
        clicking = self.labels
        if clicking is not None and clicking.doubtful:
            clicking.current = clicking.doubtful[0]
            self.doubt_found.emit(clicking.proposals[clicking.current].pixel)

    def accept_all(self, *, starts_if_good: bool = False) -> None:
        """Confirm all names that are proposed. ``starts_if_good``: with all checks good and nothing to ask it
        measures."""
        if self.labels is not None and self.labels.proposals:
            self.labels.accept_all()
            self.request_verdict(starts_if_good=starts_if_good)

    def confirm_doubtful(self) -> None:
        """The doubtful name in the loupe is right; the next one comes into it."""
        assert self.labels is not None
        self.labels.confirm(self.labels.doubtful[0])
        self._show_doubtful()
        self.request_verdict()

    def label_manually(self) -> None:
        """No more proposals: every marker is clicked by the person."""
        self._is_manual = True
        self._proposing += 1
        self.is_proposing = False
        if self.labels is not None:
            self.labels.set_proposals({})
            self.request_verdict()

    def undo(self) -> None:
        if self.labels is not None and self.labels.undo():
            self.request_proposals()
            self.request_verdict()

    def set_straight_fingers(self, answer: tuple[bool, ...]) -> None:
        if self.labels is not None and self.labels.straight_fingers != answer:
            self.labels.straight_fingers = answer
            self.request_verdict()

    # --- the verdict --------------------------------------------------------------------------------------
    def request_verdict(self, *, starts_if_good: bool = False) -> None:
        """Names are different: the old verdict no longer counts, a new one is asked for when all are there."""
        self.outcome, self._starts_if_good = None, starts_if_good
        self._judging += 1
        self.labels_changed.emit()
        calibrator, number = self.calibrator, self._judging
        if self.labels is None or not self.labels.is_complete or calibrator is None:
            self.view_changed.emit()
            return
        clicks, angles = self.labels.clicks(), self.start_angles_rad

        def handle_verdict(outcome: CalibrationAssessment) -> None:
            if number != self._judging:
                return
            self.outcome = outcome
            self.view_changed.emit()
            self.judged.emit(outcome.verdict)
            asks = calibrator.protocol.has_fingers  # which of them lie straight
            if self._starts_if_good and outcome.verdict.is_good and not asks:  # nothing is left to decide
                self.begin_tracking()

        self._background.run(
            lambda: calibrator.assess(clicks, angles),
            handle_verdict,
            lambda fault: self._raise_fault(number, fault),
            self,
        )
        self.view_changed.emit()

    def _raise_fault(self, number: int, fault: Exception) -> None:
        if number == self._judging:
            self.fault_raised.emit(fault)

    def begin_tracking(self) -> None:
        if self.outcome is not None and self.outcome.calibration is not None and self.calibrator is not None:
            self.calibrator.start_tracking(self.outcome.calibration)
            self.started.emit()

    def remedy(self) -> Remedy:
        assert self.outcome is not None
        assert self.calibrator is not None
        return find_remedy(self.outcome.verdict, is_live=self.calibrator.is_live)

    def swap(self) -> None:
        """Names that stand in for each other change places."""
        pairs = find_swapped(self.outcome.verdict) if self.outcome is not None else []
        if pairs and self.labels is not None:
            pixel = self.labels.confirmed_px
            for one, other in pairs:
                pixel[one], pixel[other] = pixel[other], pixel[one]
            self.request_verdict()

    def click_again(self) -> None:
        """Take back the markers at fault, or all of them where the fault lies with none."""
        if self.labels is None or self.outcome is None:
            if self.labels is not None and self.labels.proposals:
                self.label_manually()
            return
        self.labels.clear(find_faulty_markers(self.outcome.verdict))
        self.request_verdict()

    def accept_other_blob(self) -> None:
        """The spot in question is the disc: the name moves to it."""
        for finding in self.outcome.verdict.findings if self.outcome is not None else ():
            if finding.spot_px and finding.markers and self.labels is not None:
                (name,) = finding.markers
                self.labels.confirmed_px[name] = np.array(finding.spot_px)
        self.request_verdict()


Remedy = Literal["swap", "click_these", "correct", "take_spot", "new_picture"]

_FRAME_FINDINGS = ("tilt", "distance", "moved", "few_frames", "depth_off")
"""Causes that lie with hand, camera or light, never with the names."""


def find_remedy(verdict: Verdict, *, is_live: bool) -> Remedy:
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
    if is_live and kinds & set(_FRAME_FINDINGS):
        return "new_picture"
    if kinds & {"residual", "no_depth"}:
        return "click_these"
    return "correct"


def find_swapped(verdict: Verdict) -> list[tuple[str, str]]:
    """Names that stand in for each other: two, or those of two fingers each for each."""
    names = next((finding.markers for finding in verdict.findings if finding.kind == "swapped"), ())
    half = len(names) // 2
    return list(zip(names[:half], names[half:], strict=True))


def find_faulty_markers(verdict: Verdict) -> tuple[str, ...]:
    """The markers that something is found with."""
    return tuple(dict.fromkeys(name for finding in verdict.findings for name in finding.markers))


def remedy_face(remedy: Remedy) -> tuple[str, str]:
    """Words and key of the primary button."""
    return {
        "swap": (tr("Swap the two"), ENTER_KEY),
        "click_these": (tr("Click again"), "C"),
        "correct": (tr("Correct names"), ""),
        "take_spot": (tr("Take that spot"), ""),
        "new_picture": (tr("New picture"), "N"),
    }[remedy]
