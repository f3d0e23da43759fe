"""The tracking light: one colour, shape, word and remedy for the state of tracking."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.model.camera import Camera
from carpus.core.model.fault_text import marker_name
from carpus.core.model.hand.protocols import PALM_MARKERS
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, Frame, TrackedFrame, TrackStatus
from carpus.core.pipeline.live_values import LiveCounters, TrackedView
from carpus.ui.charts.history import MarkerVisibility
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words.terms import finger_name, marker_title, occlusion_remedy

Rank = Literal["good", "warn", "bad", "idle"]
AMBER_AFTER_S = 0.3
GREEN_AFTER_S = 0.5


@dataclass(frozen=True, slots=True)
class StatusLight:
    """Rank, state and remedy of the tracking light."""

    rank: Rank
    state: str
    remedy: str


MIN_PALM_MARKERS = 3
"""Markers of the palm needed to locate the hand."""
_DISTAL_JOINTS = ("PIP", "DIP", "TIP", "IP")


def hand_light(
    frame: TrackedFrame | None, visibility: Mapping[str, MarkerVisibility], *, has_forearm_moved: bool = False
) -> StatusLight:
    """Return the light for one frame and the visibility of its markers, without any delay."""
    if frame is None:
        return StatusLight("idle", tr("Waiting for the camera image"), "")
    if frame.status == TrackStatus.LOST:
        return StatusLight("bad", tr("Hand not visible"), tr("Hold the hand flat under the camera"))
    hidden = [name for name, state in visibility.items() if state == "hidden"]
    partly = [name for name, state in visibility.items() if state == "partly"]
    palm = sum(name in PALM_MARKERS for name in hidden)
    if len(PALM_MARKERS) - palm < MIN_PALM_MARKERS or frame.status == TrackStatus.PREDICTED:
        return StatusLight("warn", tr("Too few markers visible"), tr("Turn the back of the hand to the camera"))
    if frame.status == TrackStatus.DOUBTFUL:
        return StatusLight(
            "warn", tr("Uncertain"), tr("Markers do not match the hand: hold the hand flat for a moment")
        )
    if hidden:
        return StatusLight("warn", occlusion_words(hidden), remedy_words(hidden))
    if partly:
        return StatusLight("warn", _partly_words(partly), remedy_words(partly))
    if has_forearm_moved:
        return StatusLight("warn", tr("Forearm moved"), tr("Lay the forearm back where it was"))
    now = frame.kinematics
    if not np.isfinite(now.joint_angles_rad if len(now.joint_angles_rad) else now.angles_rad).any():
        return StatusLight("idle", tr("No angle yet"), tr("Hold the hand flat for a moment"))
    count = len(visibility)
    return StatusLight("good", tr("Hand tracked well"), tr("All {count} markers visible").format(count=count))


def occlusion_words(hidden: Sequence[str]) -> str:
    """Describe hidden markers: ``Ring tip hidden``, ``Thumb hidden``, ``7 markers hidden``."""
    if len(hidden) == 1:
        return tr("{marker} occluded").format(marker=marker_title(hidden[0]))
    fingers = {name[-1] for name in hidden if name not in PALM_MARKERS}
    if len(fingers) == 1 and all(name not in PALM_MARKERS for name in hidden):
        (finger,) = fingers
        if finger == "1":
            return tr("Thumb occluded")
        return tr("{finger} finger occluded").format(finger=finger_name(finger))
    if all(name.rstrip("12345") in _DISTAL_JOINTS for name in hidden):
        return tr("Fingertips occluded")
    return tr("{count} markers occluded").format(count=len(hidden))


def remedy_words(hidden: Sequence[str]) -> str:
    """Return what to do about hidden markers; the palm first, since tracking needs it."""
    palm = [name for name in hidden if name in PALM_MARKERS]
    if len(palm) == 1:
        return occlusion_remedy(palm[0])
    if palm:
        return tr("Turn the back of the hand to the camera")
    if all(name[-1] == "1" for name in hidden):
        return tr("Turn the thumb side up")
    if len(hidden) == 1 and hidden[0].startswith("TIP"):
        return tr("Raise the hand")
    return tr("Turn the back of the fingers to the camera")


def _partly_words(poor: Sequence[str]) -> str:
    if len(poor) == 1:
        return tr("{marker} often occluded").format(marker=marker_title(poor[0]))
    return tr("{count} markers often occluded").format(count=len(poor))


MAX_DISTANCE_M = 0.03
"""A spot may be a marker if it is this near to the marker's expected place."""
_SAME_BLOB_PX = 1.5


def marker_light(frame: TrackedFrame | None, markers: Sequence[str], camera: Camera) -> StatusLight:
    """Return the light of a doubtful marker, else of a hidden one near an unused blue spot.

    A good light without words stands for neither.
    """
    if frame is None or frame.status == TrackStatus.LOST or len(frame.marker_measured_px) != len(markers):
        return StatusLight("good", "", "")
    measured = frame.marker_measured_px
    hidden = ~np.isfinite(measured[:, 0])
    place = np.where(hidden[:, None], frame.marker_predicted_px, measured)
    unused = _find_unused_blobs(frame)
    for rows in (np.flatnonzero(frame.doubted), np.flatnonzero(hidden)):
        nearest: list[tuple[float, int]] = []
        for k in rows:
            if not np.isfinite(place[k]).all() or not len(unused):
                continue
            distance = np.linalg.norm(unused - place[k], axis=1)
            reach_px = MAX_DISTANCE_M * camera.fx_px / max(float(frame.marker_position_cam_m[k, 2]), 0.2)
            if distance.min() <= reach_px:
                nearest.append((float(distance.min()), int(k)))
        if nearest:
            row = min(nearest)[1]
            name = marker_name(markers[row], translate_phrase)
            if hidden[row]:
                return StatusLight(
                    "warn", tr("Another blue spot is here"), tr("Is it the {marker}?").format(marker=name)
                )
            return StatusLight("warn", tr("Uncertain"), tr("Which blue spot is the {marker}?").format(marker=name))
    if frame.doubted.any():
        name = marker_name(markers[int(np.flatnonzero(frame.doubted)[0])], translate_phrase)
        return StatusLight("warn", tr("Uncertain"), tr("Check the {marker}").format(marker=name))
    return StatusLight("good", "", "")


def _find_unused_blobs(frame: TrackedFrame) -> FloatArray:
    """Return spots (S, 2) assigned to no marker and not rejected by a person."""
    seen = frame.detections.pixel[~frame.is_rejected]
    taken = frame.marker_measured_px[np.isfinite(frame.marker_measured_px[:, 0])]
    if not len(seen) or not len(taken):
        return seen
    free = np.linalg.norm(seen[:, None] - taken[None], axis=-1).min(axis=1) > _SAME_BLOB_PX
    return np.asarray(seen[free])


class SteadyLight:
    """Delays changes of the light: amber after 0.3 s, green after 0.5 s, red at once.

    Words of the same rank change only when they have lasted as long.
    """

    def __init__(self) -> None:
        self._shown: StatusLight | None = None
        self._wanted: StatusLight | None = None
        self._since_s = math.nan

    def update(self, status_light: StatusLight, now_s: float) -> StatusLight:
        """Return the light to show at ``now_s``, given that of the frame."""
        if self._shown is None or status_light.rank in ("bad", "idle") or self._shown.rank == "idle":
            self._shown = self._wanted = status_light
            return status_light
        if status_light == self._shown:
            self._wanted = status_light
            return status_light
        if self._wanted is None or status_light.rank != self._wanted.rank or self._wanted == self._shown:
            self._since_s = now_s
        self._wanted = status_light
        delay_s = GREEN_AFTER_S if status_light.rank == "good" else AMBER_AFTER_S
        if now_s - self._since_s >= delay_s - 1e-9:
            self._shown = status_light
        return self._shown


LAG_S, CAUGHT_UP_S = 1.0, 0.4
"""The light reports a lag above the first value until it is below the second."""
MIN_WAITING_FRAMES = 15
"""Half a second of frames after a stop is not worth a message."""


class TrackingLag:
    """Lag of tracking behind the camera, and missing frames of a recording."""

    def __init__(self) -> None:
        self.lag_s = 0.0
        """0 while the values are current."""
        self.start_recording()

    def start_recording(self) -> None:
        self.missing_frames = 0
        """Frames of this recording that were dropped or never came."""
        self._missing_before: int | None = None
        self._max_waiting = 0

    def update(self, newest: Frame | None, view: TrackedView | None) -> bool:
        """Update the lag with the newest and the newest tracked frame; return True if it is too large."""
        late_s = 0.0 if newest is None or view is None else newest.timestamp_s - view.tracked.timestamp_s
        self.lag_s = late_s if late_s > (CAUGHT_UP_S if self.lag_s else LAG_S) else 0.0
        return self.lag_s > 0.0

    def count_missing(self, counters: LiveCounters) -> None:
        lost = counters.dropped + counters.missing
        if self._missing_before is None:
            self._missing_before = lost
        self.missing_frames = lost - self._missing_before

    def catch_up_progress(self, counters: LiveCounters) -> tuple[int, int] | None:
        """Return frames done and in all after a stop; None if hardly any are left."""
        waiting = counters.frames_waiting
        self._max_waiting = max(self._max_waiting, waiting)
        if self._max_waiting < MIN_WAITING_FRAMES or not waiting:
            return None
        return self._max_waiting - waiting, self._max_waiting


def lag_light(lag: TrackingLag, *, recording: bool) -> StatusLight:
    """Return the light while tracking lags behind."""
    if lag.missing_frames and recording:
        words = tr("{count} frames are missing: close other programs")
        return StatusLight("warn", tr("The computer is too busy"), words.format(count=lag.missing_frames))
    kept = tr("The computer is busy; every frame is saved")
    words = tr("Values are {seconds} s behind").format(seconds=format_rounded(lag.lag_s))
    return StatusLight("idle", words, kept if recording else tr("The computer is busy"))


def catch_up_words(counters: LiveCounters) -> str:
    """Return how long catching up takes, for the button that stopped."""
    if not math.isfinite(counters.tracking_lag_s):
        return tr("Analysing…")
    return tr("Analysing: {seconds} s left").format(seconds=max(1, math.ceil(counters.tracking_lag_s)))


HEIGHT_PX = 72
BANDS = {
    "good": ("good_soft", "good", "text", "good", "good_soft"),
    "warn": ("band_warn", "on_band_warn", "on_band_warn", "on_band_warn", "band_warn"),
    "bad": ("band_bad", "on_band_bad", "on_band_bad", "on_band_bad", "band_bad"),
    "idle": ("sunken", "text2", "text2", "border", "sunken"),
}
"""Colours by rank: background, state, remedy, icon body, icon sign."""
WRAP_FLAG = int(Qt.TextFlag.TextWordWrap)
TEXT_SHARES = [0.95 - 0.05 * step for step in range(10)]


class StatusLightView(QWidget):
    """Paints a :class:`StatusLight`."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.status_light = StatusLight("idle", "", "")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_light(self, status_light: StatusLight) -> None:
        """Change the light; screen readers get both lines."""
        if status_light != self.status_light:
            self.status_light = status_light
            self.setAccessibleName(f"{status_light.state}. {status_light.remedy}")
            self.update()

    def sizeHint(self) -> QSize:
        return QSize(620, self._theme.px(HEIGHT_PX))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        color, scale = self._theme.color, self._theme.text_scale
        ground, word, remedy, body, sign = BANDS[self.status_light.rank]
        painter.fillRect(self.rect(), color(ground))
        size = 36 * scale
        icon = QRectF(34, (self.height() - size) / 2, size, size)
        paint_state(
            painter,
            "open" if self.status_light.rank == "idle" else self.status_light.rank,
            icon,
            color(body),
            color(sign),
        )
        left = icon.right() + 18
        room = QRectF(left, 4, self.width() - left - 12, self.height() - 8)
        for (text, face, place), ink in zip(self._place_lines(room), (word, remedy), strict=True):
            painter.setFont(face)
            painter.setPen(color(ink))
            painter.drawText(place, WRAP_FLAG, text)

    def _place_lines(self, room: QRectF) -> list[tuple[str, QFont, QRectF]]:
        """Place state and remedy on one line if they fit, else one above the other, shrunk to fit."""
        (state, large, _), (remedy, small, _) = above = self._stack_lines(room, 1.0)
        upper, lower = QFontMetricsF(large), QFontMetricsF(small)
        beside = upper.horizontalAdvance(state) + 18
        if beside + lower.horizontalAdvance(remedy) <= room.width():
            baseline = room.center().y() + 10 * self._theme.text_scale
            left = room.translated(0, baseline - upper.ascent() - room.top())
            return [(state, large, left), (remedy, small, left.translated(beside, upper.ascent() - lower.ascent()))]
        for share in TEXT_SHARES:
            if all(room.contains(place) for *_, place in above):
                break
            above = self._stack_lines(room, share)
        return above

    def _stack_lines(self, room: QRectF, share: float) -> list[tuple[str, QFont, QRectF]]:
        """Place both lines one above the other in the middle, at ``share`` of their size."""
        placed, size = [], share * self._theme.text_scale
        for text, face in (
            (self.status_light.state, font(28 * size, SEMIBOLD)),
            (self.status_light.remedy, font(20 * size, MEDIUM)),
        ):
            placed.append((text, face, QFontMetricsF(face).boundingRect(room, WRAP_FLAG, text)))
        (*_, upper), (*_, lower) = placed
        upper.moveTop(room.center().y() - (upper.height() + lower.height()) / 2)
        lower.moveTop(upper.bottom())
        return placed
