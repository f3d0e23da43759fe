"""Labelling of the markers and their calibration, without the screen: labels of a frame, verdict, remedy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from PySide6.QtCore import QObject, Signal

from carpus.core.calibration.calibrate import MeasuredHand
from carpus.core.calibration.hand_calibrator import SAME_MARKER_PX, FoundMarker, HandCalibrator
from carpus.core.calibration.result import ALL_STRAIGHT, Clicks, Verdict
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, Frame, Side
from carpus.ui.kit.background import Background
from carpus.ui.screens.tour.bubble import LabelStage


@dataclass(slots=True)
class LabelState:
    """Labels of one frame.

    Attributes
    ----------
    confirmed_px : dict
        Pixel by marker, in the order they were set.
    current : str
        Marker to be clicked next.
    is_chosen : bool
        True if a person went to the current marker.
    proposals : dict
        Labels proposed by the program and not confirmed.
    """

    protocol: MarkerProtocol
    side: Side
    confirmed_px: dict[str, FloatArray] = field(default_factory=dict)
    widths_px: dict[str, float] = field(default_factory=dict)
    current: str = ""
    is_chosen: bool = False
    proposals: dict[str, FoundMarker] = field(default_factory=dict)
    straight_fingers: tuple[bool, ...] = ALL_STRAIGHT

    def __post_init__(self) -> None:
        self.current = self.protocol.markers[0]

    @property
    def label_px(self) -> dict[str, FloatArray]:
        """Pixel of each label, confirmed or proposed."""
        return {name: one.pixel for name, one in self.proposals.items()} | self.confirmed_px

    @property
    def missing(self) -> tuple[str, ...]:
        return tuple(name for name in self.protocol.markers if name not in self.confirmed_px)

    @property
    def is_complete(self) -> bool:
        return not self.missing

    @property
    def open_markers(self) -> tuple[str, ...]:
        return tuple(name for name in self.missing if name not in self.proposals)

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Proposals that another label would fit nearly as well."""
        return tuple(name for name in self.missing if name in self.proposals and not self.proposals[name].is_sure)

    def set_proposals(self, proposals: Mapping[str, FoundMarker]) -> None:
        """Replace the proposals of markers that are not confirmed."""
        self.proposals = {name: proposals[name] for name in self.missing if name in proposals}
        if not (self.is_chosen and self.current in self.missing):
            self.current = (self.open_markers or self.missing or (self.current,))[0]

    def accept_all(self) -> None:
        for name in self.protocol.markers:
            if name in self.proposals and name not in self.confirmed_px:
                self.confirmed_px[name] = self.proposals[name].pixel
                self.widths_px[name] = self.proposals[name].width_px
        self.proposals.clear()
        self._advance()

    def confirm(self, name: str) -> None:
        one = self.proposals.pop(name)
        self.confirmed_px[name], self.widths_px[name] = one.pixel, one.width_px
        self._advance()

    def is_proposed_at(self, pixel: FloatArray) -> bool:
        """Tell whether the current marker is proposed at this pixel."""
        mine = self.proposals.get(self.current)
        return mine is not None and _is_same_place(mine.pixel, pixel)

    def find_owner(self, pixel: FloatArray) -> str:
        """Return the label of a person at this pixel, if the current marker has none to swap; else empty."""
        if self.current in self.label_px:
            return ""
        return next((name for name, other in self.confirmed_px.items() if _is_same_place(other, pixel)), "")

    def set_label(self, pixel: FloatArray, width_px: float) -> bool:
        """Label the current marker and go to the next one; return True if two labels were swapped.

        Another label at this pixel moves to the current marker's former place, or is removed.
        """
        places = self.label_px
        had_place = places.pop(self.current, None) is not None
        swapped = had_place and any(_is_same_place(place, pixel) for place in places.values())
        mine = self.proposals.pop(self.current, None)
        before = self.confirmed_px.pop(self.current, None)
        before_width_px = self.widths_px.get(self.current, width_px)
        for name in [name for name, other in self.confirmed_px.items() if _is_same_place(other, pixel)]:
            if before is not None:
                self.confirmed_px[name], self.widths_px[name] = before, before_width_px
            elif mine is not None:
                self.confirmed_px[name], self.widths_px[name] = mine.pixel, mine.width_px
        for name in [name for name, one in self.proposals.items() if _is_same_place(one.pixel, pixel)]:
            del self.proposals[name]
            if before is not None:
                self.proposals[name] = FoundMarker(before, before_width_px)
            elif mine is not None:
                self.proposals[name] = mine
        self.confirmed_px[self.current] = np.asarray(pixel, dtype=np.float64)
        self.widths_px[self.current] = width_px
        self._advance()
        return swapped

    def undo(self) -> str:
        """Remove the label set last and return its name; empty if there is none."""
        if not self.confirmed_px:
            return ""
        name, _ = self.confirmed_px.popitem()
        self.current = name
        return name

    def clear(self, names: Sequence[str]) -> None:
        """Remove some labels, or all without ``names``."""
        for name in names:
            self.confirmed_px.pop(name, None)
        if not names:
            self.confirmed_px.clear()
            self.proposals.clear()
            self.current, self.is_chosen = self.protocol.markers[0], False
        else:
            self._advance()

    def step(self, by: int) -> None:
        self.choose(
            self.protocol.markers[(self.protocol.markers.index(self.current) + by) % len(self.protocol.markers)]
        )

    def choose(self, name: str) -> None:
        """Go to a marker; later proposals do not change it."""
        self.current, self.is_chosen = name, True

    def find_near(self, pixel: FloatArray, reach_px: float) -> str:
        """Return the marker labelled within reach of a pixel, empty for none."""
        distances = {name: float(np.hypot(*(place - pixel))) for name, place in self.label_px.items()}
        name = min(distances, key=lambda key: distances[key], default="")
        return name if name and distances[name] <= reach_px else ""

    def clicks(self) -> Clicks:
        return Clicks(
            self.side,
            self.protocol,
            np.array([self.confirmed_px[name] for name in self.protocol.markers]),
            self.straight_fingers,
        )

    def _advance(self) -> None:
        self.is_chosen = False
        missing = self.open_markers or self.missing
        if missing:
            after = [
                name
                for name in missing
                if self.protocol.markers.index(name) > self.protocol.markers.index(self.current)
            ]
            self.current = (after or list(missing))[0]


def _is_same_place(one: FloatArray, other: FloatArray) -> bool:
    return float(np.hypot(*(one - other))) < SAME_MARKER_PX


class LabellingController(QObject):
    """Labels markers on a live, then a frozen frame, and has the calibration assessed.

    Signals: ``labels_changed`` invalidates the verdict; ``view_changed`` asks for a refresh; ``doubt_found`` carries
    a pixel to look at; ``judged`` a verdict; ``fault_raised`` a fault; ``started`` follows the start of tracking.
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
        self.calibrator: HandCalibrator | None = None
        self.labels: LabelState | None = None
        self.outcome: MeasuredHand | None = None
        """Assessment of the present labels, None before."""
        self.start_angles_rad = np.zeros(3)
        self.is_proposing = False
        """True while labels are being proposed."""
        self._is_manual = self._starts_if_good = False
        self._proposing = self._judging = 0

    def open_calibrator(self, calibrator: HandCalibrator) -> None:
        self.calibrator, self.start_angles_rad = calibrator, np.zeros(3)
        self.reset()

    def reset(self) -> None:
        """Return to the live frame; results that are still computed are dropped."""
        self.labels = self.outcome = None
        self._judging += 1
        self._drop_proposals()

    def _drop_proposals(self) -> None:
        self._proposing += 1
        self.is_proposing = False

    def freeze_frame(self) -> Frame:
        calibrator = self.calibrator
        assert calibrator is not None
        frame, straight = calibrator.freeze_frame(), calibrator.previous_straight_fingers
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
        """Label the current marker at a pixel.

        Returns
        -------
        str or None
            None if done; the label that is there already; empty if there is no marker.
        """
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
        """Propose labels for the other markers, given those that a person has set."""
        self._drop_proposals()
        if self._is_manual or self.labels is None or self.calibrator is None or self.labels.is_complete:
            return
        number, calibrator, named = self._proposing, self.calibrator, dict(self.labels.confirmed_px)
        self.is_proposing = True

        def handle_proposals(proposed: Mapping[str, FoundMarker]) -> None:
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
        """Show the first doubtful label in the magnifier."""
        clicking = self.labels
        if clicking is not None and clicking.doubtful:
            clicking.current = clicking.doubtful[0]
            self.doubt_found.emit(clicking.proposals[clicking.current].pixel)

    def accept_all(self, *, starts_if_good: bool = False) -> None:
        """Confirm all proposals; with ``starts_if_good`` start measuring if all checks are good."""
        if self.labels is not None and self.labels.proposals:
            self.labels.accept_all()
            self.request_verdict(starts_if_good=starts_if_good)

    def confirm_doubtful(self) -> None:
        """Confirm the doubtful label in the magnifier and show the next one."""
        assert self.labels is not None
        self.labels.confirm(self.labels.doubtful[0])
        self._show_doubtful()
        self.request_verdict()

    def label_manually(self) -> None:
        """Stop proposing labels."""
        self._is_manual = True
        self._drop_proposals()
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
        """Drop the old verdict; request a new one if all markers are labelled."""
        self.outcome, self._starts_if_good = None, starts_if_good
        self._judging += 1
        self.labels_changed.emit()
        calibrator, number = self.calibrator, self._judging
        if self.labels is None or not self.labels.is_complete or calibrator is None:
            self.view_changed.emit()
            return
        clicks, angles = self.labels.clicks(), self.start_angles_rad

        def handle_verdict(outcome: MeasuredHand) -> None:
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
        """Swap labels that were mixed up."""
        pairs = find_swapped(self.outcome.verdict) if self.outcome is not None else []
        if pairs and self.labels is not None:
            pixel = self.labels.confirmed_px
            for one, other in pairs:
                pixel[one], pixel[other] = pixel[other], pixel[one]
            self.request_verdict()

    def click_again(self) -> None:
        """Remove the faulty labels, or all if none is at fault."""
        if self.labels is None or self.outcome is None:
            if self.labels is not None and self.labels.proposals:
                self.label_manually()
            return
        self.labels.clear(find_faulty_markers(self.outcome.verdict))
        self.request_verdict()

    def accept_other_blob(self) -> None:
        """Move the label to the other spot."""
        for finding in self.outcome.verdict.findings if self.outcome is not None else ():
            if finding.spot_px and finding.markers and self.labels is not None:
                (name,) = finding.markers
                self.labels.confirmed_px[name] = np.array(finding.spot_px)
        self.request_verdict()


Remedy = Literal["swap", "click_these", "correct", "take_spot", "new_picture"]

_FRAME_FINDINGS = ("tilt", "distance", "moved", "few_frames", "depth_off")
"""Findings caused by hand, camera or light, not by labels."""


def find_remedy(verdict: Verdict, *, is_live: bool) -> Remedy:
    """Return the most likely remedy; wrong labels come before a bad frame."""
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
    """Return pairs of swapped labels: of two markers, or of two fingers."""
    names = next((finding.markers for finding in verdict.findings if finding.kind == "swapped"), ())
    half = len(names) // 2
    return list(zip(names[:half], names[half:], strict=True))


def find_faulty_markers(verdict: Verdict) -> tuple[str, ...]:
    """Return the markers of all findings."""
    return tuple(dict.fromkeys(name for finding in verdict.findings for name in finding.markers))
