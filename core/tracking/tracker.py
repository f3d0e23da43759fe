"""The tracker: the only part of the walk that remembers.

For every frame it predicts where the discs are, lets the association name the blobs, updates the belief by them and by
the surface of the back of the hand, looks for the hand anew where too little was where it should be, and states the
angles with their standard deviations. It reads no picture and writes no file.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core import so3
from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.spot_answer import SpotAnswer
from carpus.core.tracking.disc_anew import disc_anew, with_discs_as_known
from carpus.core.tracking.doubt import DoubtWatch, passed_over
from carpus.core.tracking.finger_model import seat_of
from carpus.core.tracking.finger_smoother import FingersLookedBack, FingerStart, FingerStep, smoothed_fingers
from carpus.core.tracking.fingers import Fingers, FingerTrial, RaysAhead
from carpus.core.tracking.geometry import palm_of
from carpus.core.tracking.kernel import Bank, carried, mixed, switching
from carpus.core.tracking.motion import PalmMotion, mode_scale, palm_step, slowing, slowing_unseen, unseen_turns
from carpus.core.tracking.naming import Corrected, Measurable, measurable, name_and_correct
from carpus.core.tracking.noise_watch import watched
from carpus.core.tracking.palm_smoother import FilterStep, smoothed_palm
from carpus.core.tracking.palm_state import POSE, RELIEF, SHAPE, SIZE, SKIN, TURN, InitialSd, PalmBelief, resting_belief
from carpus.core.tracking.palm_view import Forecast, View, forecast, recentred
from carpus.core.tracking.reacquire import Facing, FoundPalm, find_palm
from carpus.core.tracking.readout import Readout, lost_frame, lost_moment
from carpus.core.tracking.said_spots import NoDisc, RecentSpots
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.shape_learning import hidden_by_calibration, shape_covariance, shape_shares
from carpus.core.tracking.soft_tissue import settled_covariance
from carpus.core.tracking.surface_fit import levelled_bank, surface_measurement
from carpus.core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

_SAME_AXIS = np.eye(2)
_NEAREST_M = 0.1
"""No camera sees a hand nearer: keeps the size of a disc finite."""
BACK_DISCS, KNUCKLES = np.arange(4), slice(2, 6)
"""WRIST, CMC1, MCP2, MCP3, which span the surface of the fixed unit."""


@dataclass(frozen=True, slots=True)
class Foreseen:
    """The hand as foreseen for one moment, of the beliefs ``palm`` and ``fingers``, which are never changed, only
    replaced: ``ahead`` of the palm, ``rays`` of the fingers where they are tracked."""

    timestamp_s: float
    palm: tuple[PalmBelief, Bank]
    fingers: Bank | None
    ahead: Forecast
    rays: RaysAhead | None


@dataclass(frozen=True, slots=True)
class Expectation:
    """Where the discs should be in the next frame: pixels (M, 2) with covariance (M, 2, 2), depths (M,); ``back_px``
    (C, 2) of those that span the surface of the back of the hand, ``finger_px`` (F, 2) of those on long fingers and
    their knuckles. ``foreseen``: what it was read of, so that the step need not foresee it again."""

    pixel: FloatArray
    covariance_px2: FloatArray
    depth_m: FloatArray
    back_px: FloatArray
    finger_px: FloatArray
    foreseen: Foreseen


@dataclass(frozen=True, slots=True)
class KeptSteps:
    """What looking back needs of some frames in a row: the palm's and the fingers' steps, and what was believed of the
    fingers before the first (None at the neutral pose)."""

    steps: Sequence[FilterStep]
    fingers: Sequence[FingerStep | None]
    finger_start: FingerStart | None


@dataclass(frozen=True, slots=True)
class _Step:
    """One frame weighed: the palm as named, its modes as errors from ``belief``, and the fingers on it.

    ``spare`` (D,) blobs that are neither's, ``is_finger`` (D,) blobs that are the fingers'; ``levelled``: the back of
    the hand was measured too.
    """

    palm: Corrected
    belief: PalmBelief
    bank: Bank
    palm_seen: int
    fingers: FingerTrial | None
    spare: NDArray[np.bool_]
    is_finger: NDArray[np.bool_]
    levelled: bool


@dataclass(frozen=True, slots=True)
class _Picture:
    """What one frame brings: its time, the time since the last, the blobs where an ideal camera would see them, and
    these as measurements; and the fingers as foreseen for it."""

    timestamp_s: float
    dt_s: float
    ideal: Detections
    blobs: Measurable
    rays: RaysAhead | None


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
        self._protocol = calibration.clicks.protocol
        self._rows = np.array(self._protocol.palm)
        self._fingers = Fingers(calibration, camera, settings) if self._protocol.has_fingers else None
        self._joint_count = 0 if self._fingers is None else self._fingers.model.reading.ray.size
        self._surface = calibration.surface if settings.use_surface and settings.use_depth else None
        calibration = palm_of(calibration)
        self._calibration = calibration
        self._calibrated_shape = shape_covariance(calibration, settings.noise.depth_stays_m)
        self.view = View(
            camera,
            calibration.rotation_w0_cam,
            calibration.translation_w0_cam_m,
            calibration.marker_position_w0_m,
            hidden_by_calibration(calibration, settings.shape_hidden),
        )
        self._scales = np.array(settings.mode_scales)
        self._motion = PalmMotion(settings.motion_noise, settings.tissue, self._scales, settings.unseen_scale)
        self._unseen: FloatArray | None = None
        self._shares = shape_shares(settings.shape_news)
        self._settled = settled_covariance(settings.tissue)
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._readout = Readout(calibration, settings.readout, camera, settings.marker_radius_m)
        self._doubt = DoubtWatch(len(self._protocol.markers), settings.doubt)
        self._recent_spots = RecentSpots(settings.said)
        self._answers: list[tuple[SpotAnswer, float]] = []
        self._taken_up: list[SpotAnswer] = []
        self._no_discs: list[NoDisc] = []
        self._held = np.zeros(len(self._protocol.markers), dtype=bool)
        self._named_anew = np.zeros(self._rows.size, dtype=bool)
        self._noise_factor = np.ones((self._rows.size, 3))
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self._recently_measured = np.zeros(self._joint_count or 3, dtype=np.int64)
        self._known: tuple[PalmBelief, Bank] | None = None
        self._shape = np.zeros(SHAPE.stop - SHAPE.start)
        self._shape_covariance = self._calibrated_shape
        self._time_s: float | None = None
        self._seen_s = -np.inf
        self._begun_s = -np.inf
        self._found_s = -np.inf
        self._anew = True
        # False from when just four discs found a palm until five lie where it has them: it is looked for all the while.
        self._is_sure = True
        self._suspected: tuple[float, FoundPalm] | None = None
        self._suspected_before: tuple[float, FoundPalm] | None = None
        self.history: list[FilterStep] = []
        self._finger_history: list[FingerStep | None] = []
        self._finger_start: FingerStart | None = None
        self._looked_back: FingersLookedBack | None = None
        self.begin_at_neutral()

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose, the hand at rest; at that time, or else with the next frame."""
        if at_s is not None:
            self._time_s = self._seen_s = at_s
        self._shape, self._shape_covariance = np.zeros_like(self._shape), self._calibrated_shape
        start = resting_belief(self.settings.initial, self._shape_covariance)
        start.covariance[RELIEF, RELIEF] = self._settled[RELIEF, RELIEF]
        self._begin(start)
        self._is_sure = True
        self._doubt.forget()
        self._named_anew[:] = False
        if self._fingers is not None:
            self._fingers.begin_at_neutral()
        self._anew = True

    def _begin(self, belief: PalmBelief) -> None:
        self._known = belief, self._resting_bank(belief)
        self._unseen = None

    def _resting_bank(self, belief: PalmBelief) -> Bank:
        return Bank.alike(np.zeros((1, SIZE)), belief.covariance[None], self._scales.size)

    @property
    def markers(self) -> tuple[str, ...]:
        """Names of the discs, in the order of every row."""
        return self._protocol.markers

    @property
    def is_lost(self) -> bool:
        return self._known is None

    def expect(self, timestamp_s: float) -> Expectation | None:
        """Where to look at that time; None when the hand is lost."""
        if self._known is None or self._is_past(timestamp_s):
            return None
        foreseen = self._foresee(timestamp_s, self._known)
        ahead = foreseen.ahead
        mean, covariance = ahead.own_mean, ahead.own_covariance
        back_px, fingers_px = mean[BACK_DISCS, :2], mean[:0, :2]
        palm = Expectation(mean[:, :2], covariance[:, :2, :2], mean[:, 2], back_px, fingers_px, foreseen)
        return palm if self._fingers is None else self._with_fingers(palm, self._fingers)

    def _foresee(self, timestamp_s: float, known: tuple[PalmBelief, Bank]) -> Foreseen:
        """The belief at that time and what the camera should see of it."""
        settings, (belief, bank) = self.settings, known
        dt_s = self._since(timestamp_s)
        if dt_s > 0.0:
            step = palm_step(belief.rate_rad_s, self._motion, dt_s, self._unseen)
            start = mixed(bank, switching(self._scales.size, settings.mode_dwell_s, dt_s))
            bank = carried(start, step)
            belief = replace(step.carries(belief, dt_s), covariance=bank.merged()[1][0])
        ahead = forecast(belief, bank, self.view, settings.spread, self._shares)
        if self._fingers is None:
            return Foreseen(timestamp_s, known, None, ahead, None)
        return Foreseen(timestamp_s, known, self._fingers.known, ahead, self._fingers.ahead(dt_s))

    def _foreseen(self, timestamp_s: float, known: tuple[PalmBelief, Bank], expected: Expectation | None) -> Foreseen:
        """What was foreseen when the picture was searched, unless other things are known by now; else anew."""
        if expected is not None:
            seen = expected.foreseen
            fingers = None if self._fingers is None else self._fingers.known
            if seen.timestamp_s == timestamp_s and seen.palm is known and seen.fingers is fingers:
                return seen
        return self._foresee(timestamp_s, known)

    def _since(self, timestamp_s: float) -> float:
        """Time since the last frame, 0 at the first."""
        return 0.0 if self._time_s is None else timestamp_s - self._time_s

    def step(
        self,
        index: int,
        timestamp_s: float,
        detections: Detections,
        dropped_before: int = 0,
        expected: Expectation | None = None,
    ) -> TrackedFrame:
        """Associate the blobs of one frame and correct the belief; the frame's result. ``expected`` of this frame,
        where it was asked for."""
        self._recent_spots.keep(index, detections.pixel)
        heard = self._heard(index, timestamp_s)
        no_disc = self._without_no_discs(timestamp_s, detections.pixel)
        if not no_disc.any():
            frame = self._stepped(index, timestamp_s, detections, dropped_before, heard, expected)
        else:
            seen = self._stepped(index, timestamp_s, detections.only(~no_disc), dropped_before, heard, expected)
            frame = replace(seen, detections=detections, no_disc=no_disc)
        self._held = np.isfinite(frame.marker_measured_px[:, 0])
        return frame

    def hear(self, answer: SpotAnswer) -> None:
        """What a person says of the blue spots of a picture shown a moment ago, from the next frame on. To be called
        between frames, where they are tracked."""
        self._answers.append((answer, math.nan))

    def taken_up(self) -> list[SpotAnswer]:
        """The answers that the frames since the last call have taken up, with the spots as they lay there."""
        out, self._taken_up = self._taken_up, []
        return out

    def _heard(self, index: int, timestamp_s: float) -> SpotAnswer | None:
        """The answer to take up now, its spots followed to this frame: the first of which a spot is seen."""
        waiting, self._answers = self._answers, []
        found: SpotAnswer | None = None
        for answer, since_s in waiting:
            asked_s = timestamp_s if math.isnan(since_s) else since_s
            now = None if found is not None else self._now(answer)
            if now is not None:
                found = replace(now, index=index)
            elif timestamp_s - asked_s < self.settings.said.answer_holds_s and answer.marker in self._protocol.markers:
                self._answers.append((answer, asked_s))
        if found is not None:
            self._take_no_discs(found, timestamp_s)
        return found

    def _now(self, answer: SpotAnswer) -> SpotAnswer | None:
        """The answer with its spots where they lie in the newest picture; None while the spot it names is not seen."""
        if answer.marker not in self._protocol.markers:
            return None

        def now_px(place: tuple[float, float]) -> tuple[float, float] | None:
            found = self._recent_spots.now_px(answer.index, np.array(place))
            return None if found is None else (float(found[0]), float(found[1]))

        place = None if answer.place_px is None else now_px(answer.place_px)
        others = tuple(spot for one in answer.not_px if (spot := now_px(one)) is not None)
        if place is None and (answer.place_px is not None or not others):
            return None
        return replace(answer, place_px=place, not_px=others)

    def _take_no_discs(self, answer: SpotAnswer, timestamp_s: float) -> None:
        marker = self._protocol.markers.index(answer.marker)
        beside = self._expected_px(timestamp_s)[marker]
        for place in answer.not_px:
            place_px = np.array(place)
            self._no_discs.append(NoDisc(marker, place_px, place_px - beside, timestamp_s, self.settings.said))
        self._held[marker] = False
        if answer.place_px is None:
            self._taken_up.append(answer)

    def _expected_px(self, timestamp_s: float) -> FloatArray:
        """Where the markers should be in the picture (M, 2), NaN while the hand is lost."""
        expected = self.expect(timestamp_s)
        if expected is None:
            return np.full((len(self._protocol.markers), 2), np.nan)
        return self.view.camera.distort(expected.pixel)

    def _without_no_discs(self, timestamp_s: float, pixel: FloatArray) -> NDArray[np.bool_]:
        """Which spots (D, 2) a person said are none of the markers they were asked about."""
        out = np.zeros(len(pixel), dtype=bool)
        self._no_discs = [one for one in self._no_discs if one.holds(timestamp_s)]
        if not self._no_discs:
            return out
        expected_px = self._expected_px(timestamp_s)
        for one in self._no_discs:
            found = one.find(pixel, expected_px, self._held)
            if found >= 0:
                out[found] = True
        return out

    def _stepped(
        self,
        index: int,
        timestamp_s: float,
        detections: Detections,
        dropped_before: int,
        heard: SpotAnswer | None,
        expected: Expectation | None,
    ) -> TrackedFrame:
        """:meth:`step` of the spots that may be discs."""
        picture, linked = self._begun(timestamp_s, detections)
        if self._known is None:
            return self._lost(index, timestamp_s, detections, dropped_before)
        if heard is not None and heard.place_px is not None:
            self._look_anew(heard, heard.place_px, detections)
        foreseen = self._foreseen(timestamp_s, self._known, expected)
        ahead = foreseen.ahead
        picture = replace(picture, blobs=self._measurable(ahead, picture.ideal), rays=foreseen.rays)
        if heard is not None and heard.place_px is not None:
            ahead, linked = self._named_by_person(heard, heard.place_px, picture, ahead, detections, linked)
        step = self._weighed(picture, ahead)
        ahead, step, linked, turn_sd_rad = self._found_elsewhere(picture, ahead, step, linked)
        holding = self.settings.holding
        blind_rad = holding.blind_rad if self._fingers is None else holding.blind_among_fingers_rad
        if step.palm_seen < len(blind_rad) and turn_sd_rad > blind_rad[step.palm_seen]:
            step = self._weighed(self._blind(picture, ahead), ahead)
        if step.palm_seen < self._least_seen(timestamp_s):
            # Found a moment ago, and the next pictures do not bear it out: it was no hand, or not there.
            return self._lost(index, timestamp_s, detections, dropped_before)
        unseen = self._unseen
        status = self._accepted(picture, step)
        if status is None:
            return self._lost(index, timestamp_s, detections, dropped_before)
        finger_step = None
        if self._fingers is not None and step.fingers is not None:
            finger_step = self._fingers.accept(step.fingers, timestamp_s, picture.dt_s)
        self._remember(timestamp_s, self._measured(step))
        if self._keep_history and self._known is not None:
            self._finger_history.append(finger_step)
            scale = mode_scale(step.bank.probability[0], self._scales)
            self.history.append(FilterStep(timestamp_s, self._known[0], scale, linked, unseen))
        return self._shown(index, status, picture, ahead, step, detections, dropped_before)

    def _look_anew(self, heard: SpotAnswer, place_px: tuple[float, float], detections: Detections) -> None:
        """Look for a finger anew of which a person has said which spot a disc is."""
        marker = self._protocol.markers.index(heard.marker)
        is_there = _is_there(np.linalg.norm(detections.pixel - place_px, axis=1))
        if self._fingers is not None and is_there and marker not in self._rows:
            chains = self._protocol.chains.items()
            self._fingers.look_anew(next(digit for digit, chain in chains if marker in chain) - 1)

    def _named_by_person(
        self,
        heard: SpotAnswer,
        place_px: tuple[float, float],
        picture: _Picture,
        ahead: Forecast,
        detections: Detections,
        linked: bool,
    ) -> tuple[Forecast, bool]:
        """The forecast, and whether the step follows from the one before, when a person has said which spot a marker
        is: a disc of the palm begins anew there."""
        away = np.linalg.norm(detections.pixel - place_px, axis=1)
        if not _is_there(away):
            return ahead, linked
        marker = self._protocol.markers.index(heard.marker)
        self._taken_up.append(heard)
        self._doubt.forget()
        on_palm = np.flatnonzero(self._rows == marker)
        if not on_palm.size:
            return ahead, linked
        disc = int(on_palm[0])
        belief, bank, self.view = disc_anew(ahead, self.view, disc, int(away.argmin()), picture.blobs, self.settings)
        self._noise_factor[disc] = 1.0
        self._named_anew[disc] = True
        self._known = belief, bank
        ahead = forecast(belief, bank, self.view, self.settings.spread, self._shares)
        return ahead, False

    def _begun(self, timestamp_s: float, detections: Detections) -> tuple[_Picture, bool]:
        """The picture to weigh, and whether it follows from the one before; the belief may be lost or found here."""
        ideal = detections
        if self.view.camera.is_distorted:
            undistort = self.view.camera.undistort
            surface, fingers = (
                None if some is None else replace(some, pixel=undistort(some.pixel))
                for some in (detections.surface, detections.fingers)
            )
            ideal = replace(detections, pixel=undistort(detections.pixel), surface=surface, fingers=fingers)
        self._suspected_before, self._suspected = self._suspected, None
        linked, self._anew = not self._anew, False
        if not linked:
            self._begun_s = timestamp_s
        if self._is_past(timestamp_s):
            self._give_up()
        if self._known is None:
            found = self._found(ideal, self._anyhow())
            if found is not None and self._is_borne_out(found, timestamp_s):
                self._begin(self._belief_found(found))
                self._is_sure = found.count > self.settings.finding.least
                self._seen_s, linked, self._time_s = timestamp_s, False, timestamp_s
                self._found_s = timestamp_s
        nothing = Measurable(np.empty((0, 3)), np.empty((0, 3)))
        return _Picture(timestamp_s, self._since(timestamp_s), ideal, nothing, None), linked

    def _finding_view(self) -> View:
        """The palm to look for: as calibrated, but for discs that a person showed elsewhere."""
        return with_discs_as_known(self.view, self._shape, self._named_anew)

    def _found(self, ideal: Detections, facing: Facing) -> FoundPalm | None:
        """The palm as the blobs show it, wherever it was expected."""
        strays = self._settled[SKIN, SKIN] + self._shape_covariance
        reach = None if self._fingers is None else self._fingers.reach
        return find_palm(ideal, self._finding_view(), strays, facing, self.settings.finding, reach)

    def _is_borne_out(self, found: FoundPalm, timestamp_s: float) -> bool:
        """Whether a palm found out of nothing is to be believed: among the discs of fingers some four often look like
        one, and only the palm goes on doing so."""
        if self._fingers is None or found.count > self.settings.finding.least:
            return True
        holding, since_s = self.settings.holding, timestamp_s
        if self._suspected_before is not None:
            first_s, before = self._suspected_before
            goes_on = _apart_rad(before, found) < holding.turn_slack_rad
            if goes_on and np.array_equal(before.matched, found.matched):
                since_s = first_s
        self._suspected = since_s, found
        return timestamp_s - since_s >= holding.suspected_s

    def _found_elsewhere(
        self, picture: _Picture, ahead: Forecast, step: _Step, linked: bool
    ) -> tuple[Forecast, _Step, bool, float]:
        """The step from a place found without prediction, where too little of the palm is where it was expected or too
        little was expected; else all as it was. With it how surely the turn was expected, radians."""
        turn_sd_rad = _turn_sd_rad(ahead.nominal)
        vague = turn_sd_rad > self.settings.holding.vague_rad
        few = step.palm_seen <= self.settings.holding.least_discs or not self._is_sure
        if not ((few or vague) and np.count_nonzero(step.spare) + step.palm_seen > self.settings.holding.least_discs):
            return ahead, step, linked, turn_sd_rad
        ideal = picture.ideal if vague else picture.ideal.only(~step.is_finger)
        facing = self._facing(ahead.nominal, picture.timestamp_s) if self._is_sure else self._anyhow()
        found = self._found(ideal, facing)
        if found is None or not (vague or found.count > step.palm_seen):
            return ahead, step, linked, turn_sd_rad
        is_expected = _apart_rad(ahead.nominal, found) < self.settings.holding.turn_slack_rad
        if vague and not (is_expected or self._is_borne_out(found, picture.timestamp_s)):
            return ahead, step, linked, turn_sd_rad
        belief = self._belief_found(found)
        there = forecast(belief, self._resting_bank(belief), self.view, self.settings.spread, self._shares)
        step_there = self._weighed(picture, there)
        agreed = (
            turn_sd_rad < self.settings.holding.too_vague_rad
            and np.array_equal(step_there.palm.taken, step.palm.taken)
            and self._fits(step.palm)
        )
        if agreed or step_there.palm_seen < max(self.settings.holding.least_discs + 1, step.palm_seen):
            return ahead, step, linked, turn_sd_rad
        self._is_sure = found.count > self.settings.finding.least
        # A vague belief has nothing against the place found: the smoother may go on through it.
        return there, step_there, linked and vague, 0.0

    def _blind(self, picture: _Picture, ahead: Forecast) -> _Picture:
        """The picture without any blob: any would do for a disc of a hand that may be anywhere."""
        none = picture.ideal.only(np.zeros(len(picture.ideal), dtype=bool))
        return replace(picture, ideal=none, blobs=self._measurable(ahead, none))

    def _accepted(self, picture: _Picture, step: _Step) -> TrackStatus | None:
        """Go on from a step; its status, None when the hand has been out of sight for too long."""
        timestamp_s, dt_s = picture.timestamp_s, picture.dt_s
        self._time_s = timestamp_s
        self._unseen = None
        if step.palm_seen >= self.settings.holding.least_discs and not step.levelled:
            seen = step.palm.taken >= 0
            self._unseen = unseen_turns(self.view.palm_m[seen], self.settings.holding.narrow_m)
        self._noise_factor = watched(self._noise_factor, step.palm, dt_s, self.settings.noise)
        self._shape = step.belief.value[SHAPE]
        self._shape_covariance = step.belief.covariance[SHAPE, SHAPE]
        if step.palm_seen > self.settings.finding.least and self._fits(step.palm):
            self._is_sure = True
        if step.palm_seen >= self.settings.holding.least_discs:
            self._known, self._seen_s = (step.belief, step.bank), timestamp_s
            if self._unseen is not None:
                self._slow(slowing_unseen(float(np.exp(-dt_s / self.settings.rate_memory_s)), self._unseen))
            return TrackStatus.TRACKED
        if timestamp_s - max(self._seen_s, self._begun_s) > self.settings.lost_after_s:
            return None
        # An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows.
        self._known = step.belief, step.bank
        self._slow(np.diag(slowing(float(np.exp(-dt_s / self.settings.rate_memory_s)))))
        return TrackStatus.PREDICTED

    def _slow(self, kept: FloatArray) -> None:
        """Let velocities fade: what is known times ``kept`` (n, n)."""
        assert self._known is not None
        belief, bank = self._known
        belief = PalmBelief(belief.rotation_w2_w0, kept @ belief.value, kept @ belief.covariance @ kept.T)
        self._known = belief, Bank(bank.mean @ kept.T, kept @ bank.covariance @ kept.T, bank.probability)

    def _is_past(self, timestamp_s: float) -> bool:
        """Whether no picture came for so long that where the hand was says nothing of where it is."""
        return self._time_s is not None and timestamp_s - self._time_s > self.settings.lost_after_s

    def _give_up(self) -> None:
        self._known = None
        if self._fingers is not None:
            self._fingers.begin_anywhere()

    def _least_seen(self, timestamp_s: float) -> int:
        """Discs of the palm without which a hand found again is given up."""
        if timestamp_s == self._found_s:
            return self.settings.holding.least_discs + 1
        return (
            self.settings.holding.least_discs if timestamp_s - self._found_s < self.settings.holding.probation_s else 0
        )

    def _fits(self, palm: Corrected) -> bool:
        """Whether the discs lie where the corrected pose puts them."""
        return bool((np.abs(palm.raw_residual) <= self.settings.noise.outlier_sd).all())

    def _anyhow(self) -> Facing:
        """How far a hand can be turned of which nothing is known."""
        return Facing(np.eye(3), self.settings.holding.most_turn_rad)

    def _facing(self, expected: PalmBelief, timestamp_s: float) -> Facing:
        """How far a hand can have turned since it was last seen."""
        gone_s, holding = timestamp_s - max(self._seen_s, self._begun_s), self.settings.holding
        turned_rad = holding.turn_slack_rad + holding.most_rate_rad_s * gone_s
        return Facing(expected.rotation_w2_w0, min(turned_rad, holding.most_turn_rad))

    def _measurable(self, ahead: Forecast, ideal: Detections) -> Measurable:
        depth_m = max(float(ahead.own_mean[0, 2]), _NEAREST_M)
        camera = self.view.camera
        return measurable(ideal, camera.fx_px * self.settings.marker_radius_m / depth_m, self.settings, camera.sensor)

    def _weighed(self, picture: _Picture, ahead: Forecast) -> _Step:
        """Palm and fingers named and corrected, the fingers by what the palm leaves; nothing is remembered."""
        blobs = picture.blobs
        named = name_and_correct(
            ahead, blobs, self.settings.holding.least_discs + 1, self._resolution_px2, self._noise_factor, self.settings
        )
        belief, bank = recentred(ahead.nominal, named.bank)
        by_surface = self._levelled(picture, belief, bank)
        levelled = by_surface is not None
        belief, bank = by_surface or (belief, bank)
        spare = np.ones(len(blobs), dtype=bool)
        is_named = named.taken >= 0
        spare[named.taken[is_named]] = False
        palm_seen = int(np.count_nonzero(is_named))
        if self._fingers is None or picture.rays is None:
            return _Step(named, belief, bank, palm_seen, None, spare, np.zeros(len(blobs), dtype=bool), levelled)
        seat = seat_of(belief, self.view, self._readout)
        fingers = self._fingers.weigh(
            picture.rays, picture.dt_s, seat, blobs, picture.ideal.area_px, spare, picture.ideal.fingers
        )
        is_finger = np.zeros_like(spare)
        is_finger[fingers.blob[fingers.blob >= 0]] = True
        return _Step(named, belief, bank, palm_seen, fingers, spare & ~is_finger, is_finger, levelled)

    def _levelled(self, picture: _Picture, belief: PalmBelief, bank: Bank) -> tuple[PalmBelief, Bank] | None:
        """The palm corrected by the surface of the back of the hand; None where that says nothing."""
        if self._surface is None or picture.ideal.surface is None:
            return None
        own = self.settings.surface
        found = surface_measurement(belief, picture.ideal.surface, self._surface, self.view, own)
        levelled = None if found is None else levelled_bank(bank, found, self._shares, own)
        return None if levelled is None else recentred(belief, levelled)

    def _with_fingers(self, palm: Expectation, fingers: Fingers) -> Expectation:
        foreseen = palm.foreseen
        assert foreseen.rays is not None
        pixel, covariance, depth = fingers.expected(foreseen.rays, foreseen.ahead.nominal, self.view)
        covariance = covariance + palm.covariance_px2.max(axis=0)
        return Expectation(
            self._by_marker(palm.pixel, pixel),
            self._by_marker(palm.covariance_px2, covariance),
            self._by_marker(palm.depth_m, depth),
            palm.back_px,
            np.concatenate((palm.pixel[KNUCKLES], pixel[1:][fingers.model.has_discs[1:]].reshape(-1, 2))),
            foreseen,
        )

    def _by_marker(self, palm: NDArray[Any], fingers: NDArray[Any] | None) -> NDArray[Any]:
        """Rows (M, ...) of the protocol from those of the palm (6, ...) and of the rays' discs (5, 3, ...)."""
        if fingers is None or self._fingers is None:
            return palm
        model = self._fingers.model
        out = np.empty((len(self._protocol.markers), *palm.shape[1:]), dtype=palm.dtype)
        out[self._rows], out[model.markers] = palm, fingers[model.has_discs]
        return out

    def _shown(
        self,
        index: int,
        status: TrackStatus,
        picture: _Picture,
        ahead: Forecast,
        step: _Step,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """The row of a tracked or predicted frame."""
        belief, fingers = step.belief, step.fingers
        taken = self._by_marker(step.palm.taken, None if fingers is None else fingers.blob)
        used = np.flatnonzero(taken >= 0)
        blob = taken[used]
        measured_px = np.full((taken.size, 2), np.nan)
        measured_depth_m = np.full(taken.size, np.nan)
        measured_px[used] = detections.pixel[blob]
        measured_depth_m[used] = detections.depth_m[blob]
        predicted_px, predicted_cov_px2 = ahead.own_mean[:, :2], ahead.own_covariance[:, :2, :2]
        discs = self.view.discs_cam_m(belief)
        moment, nis, dof = self._readout.moment(belief), step.palm.nis, step.palm.dof
        surprise = (step.palm.raw_residual**2).sum(axis=-1)
        if self._fingers is not None and fingers is not None:
            joints = self._fingers.read(fingers)
            moment = self._readout.with_joints(moment, joints, belief)
            discs = self._by_marker(discs, joints.disc_cam_m)
            predicted_px = self._by_marker(predicted_px, fingers.predicted_px)
            predicted_cov_px2 = self._by_marker(predicted_cov_px2, fingers.predicted_cov_px2)
            surprise = self._by_marker(surprise, fingers.surprise)
            nis, dof = float(np.nansum([nis, fingers.nis])), dof + fingers.dof
        over = passed_over(
            self.view.camera.project(discs), discs[:, 2], taken, picture.ideal.pixel, picture.ideal.depth_m,
            self.view.camera.fx_px, self.settings.doubt,
        )  # fmt: skip
        doubt = self._doubt.watch(picture.dt_s, over, nis, dof, int(surprise.argmax()))
        if doubt.is_any and status is TrackStatus.TRACKED:
            status = TrackStatus.DOUBTFUL
            moment = replace(
                moment,
                angles_sd_rad=moment.angles_sd_rad * doubt.widens,
                joint_angles_sd_rad=moment.joint_angles_sd_rad * doubt.widens,
            )
        return TrackedFrame(
            index=index,
            timestamp_s=picture.timestamp_s,
            status=status,
            moment=moment,
            marker_position_cam_m=discs,
            marker_predicted_px=self.view.camera.distort(predicted_px),
            marker_predicted_cov_px2=predicted_cov_px2 + self.settings.noise.pixel_sd_px**2 * _SAME_AXIS,
            marker_measured_px=measured_px,
            marker_measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._share(),
            nis=nis if dof else math.nan,
            nis_dof=dof,
            doubted=doubt.doubted,
        )

    def _lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        self._give_up()
        self._doubt.forget()
        self._time_s = timestamp_s
        self._remember(timestamp_s, np.zeros(self._joint_count or 3, dtype=np.int64))
        if self._keep_history:
            self._finger_history.append(None)
            self.history.append(FilterStep(timestamp_s, None, 1.0, False))
        count = len(self._protocol.markers)
        moment = lost_moment(self._joint_count, count)
        return lost_frame(index, timestamp_s, moment, count, detections, dropped_before, self._share())

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, so that the rest is worth a look."""
        return len(blobs) <= self.settings.holding.least_discs

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept. Tracking may go on meanwhile."""
        beliefs = smoothed_palm(list(self.history), self._motion)
        readout = Readout(self._calibration, self.settings.readout, self.view.camera, self.settings.marker_radius_m)
        lost = lost_moment(self._joint_count, len(self._protocol.markers))
        moments = [lost if belief is None else readout.moment(belief) for belief in beliefs]
        if self._fingers is None:
            return moments
        seats = [None if belief is None else seat_of(belief, self.view, readout) for belief in beliefs]
        self._looked_back = smoothed_fingers(
            self._fingers.model, self._finger_history[: len(beliefs)], seats, self._finger_start
        )
        return [
            lost if joints is None or belief is None else readout.with_joints(moment, joints, belief)
            for moment, joints, belief in zip(moments, self._looked_back.moments, beliefs, strict=True)
        ]

    def forget(self, before_s: float = math.inf) -> None:
        """Give up what :meth:`smoothed` needs of frames before that time, all of them or some just looked back at."""
        count = sum(step.timestamp_s < before_s for step in self.history)
        if not count:
            return
        if self._fingers is not None:
            if count == len(self.history):
                self._finger_start = self._fingers.start(self.history[-1].timestamp_s, self._known is None)
            elif self._looked_back is not None:
                self._finger_start = self._looked_back.start_after(count, self._fingers.model)
            self._looked_back = None
        del self._finger_history[:count]
        del self.history[:count]

    def hand_over(self) -> KeptSteps:
        """Give up what :meth:`smoothed` needs of the frames so far, for another tracker of the same hand."""
        kept = KeptSteps(list(self.history), list(self._finger_history), self._finger_start)
        self.forget()
        return kept

    def take_over(self, kept: KeptSteps) -> None:
        """Take what another tracker of the same hand handed over, to look back at it; it goes on from what was taken
        before."""
        if not self.history:
            self._finger_start = kept.finger_start
        self._finger_history += kept.fingers
        self.history += kept.steps

    def _measured(self, step: _Step) -> NDArray[np.int64]:
        """Discs of the palm (3,), or whether each joint (J,), that were measured directly."""
        if self._fingers is None or step.fingers is None:
            return np.full(3, step.palm_seen)
        seen = self._by_marker(step.palm.taken, step.fingers.blob) >= 0
        return np.asarray(seen[self._fingers.model.direct_markers].all(axis=-1), dtype=np.int64)

    def _belief_found(self, found: FoundPalm) -> PalmBelief:
        finding = self.settings.finding
        initial = InitialSd(velocity_m_s=finding.velocity_m_s, rate_rad_s=finding.rate_rad_s)
        belief = resting_belief(initial, self._shape_covariance)
        belief.covariance[POSE[:, None], POSE] = found.pose_covariance(self.view.palm_m, finding)
        belief.covariance[SKIN, SKIN] = self._settled[SKIN, SKIN]
        belief.covariance[RELIEF, RELIEF] = self._settled[RELIEF, RELIEF]
        belief.value[SHAPE], belief.value[:3] = self._shape, found.position_m
        return replace(belief, rotation_w2_w0=found.rotation_w2_w0)

    def _remember(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._recently_measured = self._recently_measured + measured
        while self._recent[0][0] < timestamp_s - self.settings.holding.share_window_s:
            self._recently_measured = self._recently_measured - self._recent.popleft()[1]

    def _share(self) -> FloatArray:
        """Share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._rows.size if self._fingers is None else 1
        return np.asarray(self._recently_measured / (possible * len(self._recent)))


def _is_there(away_px: FloatArray) -> bool:
    """Whether one of the spots so far away (D,) is the one that was shown."""
    return bool(away_px.size and away_px.min() <= 0.5)


def _apart_rad(one: PalmBelief | FoundPalm, other: FoundPalm) -> float:
    """By how much two palms are turned against each other."""
    return float(np.linalg.norm(so3.log(one.rotation_w2_w0.T @ other.rotation_w2_w0)))


def _turn_sd_rad(belief: PalmBelief) -> float:
    """How surely the hand's turn is known, all axes and modes together."""
    return math.sqrt(float(np.trace(belief.covariance[TURN, TURN])))
