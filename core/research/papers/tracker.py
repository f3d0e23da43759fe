"""The papers' filter over the frames of one hand, in the form of the tracker that it stands in for.

The filter is the augmented unscented one of Kandepu et al. (2008): the noise of the motion is part of the state from
which the sigma points are drawn, so that it may enter nonlinearly; that of the measurement is added, as in (11).

What the papers leave open is done in the plainest way. They say when a hand is found, neutral and all in sight, not
when it is lost nor how it is found again: here it is lost when too little of the palm was measured for too long, or
when the covariance is none any more, and it is found again as at the start, at the neutral pose.

Rotations are the papers' Euler angles, R = Rz(psi) Ry(theta) Rx(phi), the order ZYX of the hand paper (section 2). The
wrist paper's own order, ZYZ, has no value at the neutral pose, where its filter starts: of alpha and gamma only the sum
is defined there. Both papers' filters are therefore run in the order of the second.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Self

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.neutral_pose import with_w0_from_markers
from carpus.core.calibration.result import Calibration
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.hand import clinical_angles
from carpus.core.model.hand.anatomy_prior import Gaussian
from carpus.core.model.hand.protocols import SITES, joint_angle_names, markers_at_joint
from carpus.core.model.types import Detections, FloatArray, KinematicState, TrackedFrame, TrackStatus
from carpus.core.pipeline import stored_settings
from carpus.core.pipeline.stored_settings import StoredSettings
from carpus.core.pipeline.track import NeutralNoise, TrackSettings, is_of_other_filter
from carpus.core.research.papers.hand_model import PaperSettings, calibrate_as_written, measure_hand
from carpus.core.session.values import Session
from carpus.core.tracking.filter.mixture_filter import UnscentedParameters, compute_weights
from carpus.core.tracking.filter.readout import build_lost_frame, nan_kinematics

# States (P, n) after a step from states (P, n) and noises (P, k).
StateTransition = Callable[[FloatArray, FloatArray], FloatArray]


@dataclass(frozen=True, slots=True)
class PredictedState:
    """The predicted state: sigma points (P, n) X_n,t|t-1 with weights (P,), and their Gaussian."""

    points: FloatArray
    mean_weight: FloatArray
    covariance_weight: FloatArray
    state: Gaussian


@dataclass(frozen=True, slots=True)
class PredictedOutputs:
    """Mean (10) and covariance (11) of m outputs of the predicted points, without measurement noise.

    ``cross_covariance`` (n, m) with the state.
    """

    mean: FloatArray
    covariance: FloatArray
    cross_covariance: FloatArray


def compute_sigma_offsets(covariance: FloatArray, scale: float) -> FloatArray:
    """Return the offsets (..., 2n+1, n) of the sigma points for covariances (..., n, n).

    Raises
    ------
    numpy.linalg.LinAlgError
        When a covariance is not positive definite.
    """
    root = np.linalg.cholesky(covariance)
    columns = np.swapaxes(root, -1, -2) * scale
    n = covariance.shape[-1]
    out = np.zeros((*covariance.shape[:-2], 2 * n + 1, n))
    out[..., 1 : n + 1, :] = columns
    out[..., n + 1 :, :] = -columns
    return out


def predict_state(
    state: Gaussian, noise_covariance: FloatArray, motion: StateTransition, scaling: UnscentedParameters
) -> PredictedState:
    """Draw points over state and noise (k, k) together and move them.

    Raises
    ------
    numpy.linalg.LinAlgError
        When the covariance of the state is none.
    """
    n, k = state.mean.size, noise_covariance.shape[0]
    weights = compute_weights(n + k, scaling)
    both = np.zeros((n + k, n + k))
    both[:n, :n], both[n:, n:] = state.covariance, noise_covariance
    offsets = compute_sigma_offsets(both, weights.scale)
    points = motion(state.mean + offsets[:, :n], offsets[:, n:])
    mean = weights.mean @ points
    deviation = points - mean
    covariance = (deviation * weights.covariance[:, None]).T @ deviation
    return PredictedState(points, weights.mean, weights.covariance, Gaussian(mean, covariance))


def predict_outputs(predicted: PredictedState, outputs: FloatArray) -> PredictedOutputs:
    """Return mean and covariances of outputs (P, m) of the predicted points."""
    mean = predicted.mean_weight @ outputs
    deviation = outputs - mean
    weighted = deviation * predicted.covariance_weight[:, None]
    return PredictedOutputs(mean, weighted.T @ deviation, (predicted.points - predicted.state.mean).T @ weighted)


def update_state(
    predicted: PredictedState, outputs: PredictedOutputs, measured: FloatArray, noise_variance: FloatArray
) -> tuple[Gaussian, float]:
    """Update the state by measurements (m,) with noise variances (m,); return its NIS too."""
    if not measured.size:
        return predicted.state, float("nan")
    innovation = measured - outputs.mean
    spread = outputs.covariance + np.diag(noise_variance)
    gain = np.linalg.solve(spread, outputs.cross_covariance.T).T
    covariance = predicted.state.covariance - gain @ spread @ gain.T
    state = Gaussian(predicted.state.mean + gain @ innovation, 0.5 * (covariance + covariance.T))
    return state, float(innovation @ np.linalg.solve(spread, innovation))


def rotation_from_euler(euler_rad: FloatArray) -> FloatArray:
    """Return R (..., 3, 3) of psi, theta, phi (..., 3)."""
    return clinical_angles.rotation_from_angles(euler_rad, "right")


def euler_from_rotation(rotation: FloatArray, near_rad: FloatArray) -> FloatArray:
    """Return psi, theta, phi (..., 3), whole turns chosen to lie nearest to ``near_rad`` (..., 3)."""
    raw = clinical_angles.angles_from_rotation(rotation, "right")
    return np.asarray(raw + 2.0 * np.pi * np.round((near_rad - raw) / (2.0 * np.pi)))


def body_rate_matrix(euler_rad: FloatArray) -> FloatArray:
    """Return (3, 3): the turn d of R Exp(d), in W2, of a small change of psi, theta, phi (3,)."""
    _, theta, phi = euler_rad
    s, c = np.sin((theta, phi)), np.cos((theta, phi))
    return np.array([[-s[0], 0.0, 1.0], [c[0] * s[1], c[1], 0.0], [c[0] * c[1], -s[1], 0.0]])


# The papers' state and how it moves: x = (T, v, psi, theta, phi, theta_1..J) and (1) of both papers.
POSITION, VELOCITY, EULER, JOINTS = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, None)
PALM_STATES, PALM_NOISES = 9, 6
# The papers' dt. Other steps keep the density of the noise, so that a missing frame counts as the time it is.
_SAMPLE_S = 1.0 / 30.0


@dataclass(frozen=True, slots=True)
class PaperMotion:
    """(1) for a hand with ``joint_count`` joint angles; noises have unit variance and are scaled here."""

    settings: PaperSettings
    joint_count: int

    @property
    def noise_covariance(self) -> FloatArray:
        """Covariance (6 + J, 6 + J) of eta_v, eta_omega and eta_theta in their standard deviations."""
        return np.eye(PALM_NOISES + self.joint_count)

    def neutral_state(self) -> Gaussian:
        """Return the state at rest at the pose that was clicked."""
        s, joints = self.settings, self.joint_count
        sd = [s.position_start_m] * 3 + [s.velocity_start_m_s] * 3 + [s.angle_start_rad] * 3
        sd += [s.joint_start_rad] * joints
        return Gaussian(np.zeros(PALM_STATES + joints), np.diag(np.square(sd)))

    def build_transition(self, dt_s: float) -> StateTransition:
        """Return (1) over ``dt_s``, for many states (P, n) and noises (P, k) at once."""
        s = self.settings
        by_noise = math.sqrt(_SAMPLE_S * dt_s)  # eta dt, eta of variance sd^2 dt_0 / dt

        def transition(state: FloatArray, noise: FloatArray) -> FloatArray:
            pushed = noise * by_noise
            out = state.copy()
            out[:, POSITION] += state[:, VELOCITY] * dt_s
            out[:, VELOCITY] += s.acceleration_m_s2 * pushed[:, 0:3]
            turned = rotation_from_euler(state[:, EULER]) @ so3.exp(s.turn_rate_rad_s * pushed[:, 3:6])
            out[:, EULER] = euler_from_rotation(turned, state[:, EULER])
            out[:, JOINTS] += s.joint_rate_rad_s * pushed[:, 6:]
            return out

        return transition


# Association as in the papers: eq. (6) to (12) of the wrist paper, (3) to (10) of the hand paper. Every blob goes to
# the marker, or to clutter, of largest posterior (12), whatever the other blobs do. Where several go to one marker, the
# one of them that (12) gives most stays with it; the papers leave that to a thesis.
def log_posteriors(
    pixel: FloatArray, predicted_px: FloatArray, covariance_px2: FloatArray, clutter_prior: float, resolution_px2: float
) -> FloatArray:
    """Return the logarithm of (12), not normalised, (D, 1 + M), column 0 clutter.

    Parameters
    ----------
    pixel : (D, 2)
        Blobs.
    predicted_px : (M, 2)
        (10) of every marker.
    covariance_px2 : (M, 2, 2)
        (11) of every marker, noise included.
    clutter_prior : float
        p(a = 0).
    resolution_px2 : float
        Area of the image.
    """
    count = len(predicted_px)
    apart = pixel[:, None] - predicted_px
    root = np.linalg.cholesky(covariance_px2)
    u = apart[..., 0] / root[:, 0, 0]
    v = (apart[..., 1] - root[:, 1, 0] * u) / root[:, 1, 1]
    log_size = np.log(root[:, 0, 0] * root[:, 1, 1])
    out = np.empty((len(pixel), 1 + count))
    out[:, 0] = math.log(clutter_prior) - math.log(resolution_px2)
    out[:, 1:] = math.log((1.0 - clutter_prior) / count) - 0.5 * (u * u + v * v) - math.log(2.0 * math.pi) - log_size
    return out


def assign_blobs(posterior: FloatArray) -> NDArray[np.int64]:
    """Return the blob of every marker (M,), -1 for none, from the logarithms (D, 1 + M) of (12)."""
    assigned = np.full(posterior.shape[1] - 1, -1, dtype=np.int64)
    best = np.full(assigned.size, -np.inf)
    for blob, choice in enumerate(posterior.argmax(axis=1).tolist()):
        if choice and posterior[blob, choice] > best[choice - 1]:
            best[choice - 1], assigned[choice - 1] = posterior[blob, choice], blob
    return assigned


MIN_PALM_MARKERS = 3
_SHARE_WINDOW_S = 1.0
_MIN_DEPTH_M = 0.05  # a sigma point may lie behind the camera; it is projected from here
_MAX_ANGLE_RAD = 4.0 * np.pi  # angles that wound up further than two whole turns are of no hand


class PaperTracker:
    """Tracks one calibrated hand by colour alone, as both papers do."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: PaperSettings) -> None:
        self.settings = settings
        self._camera = camera
        self._side = calibration.clicks.side
        self._start = clinical_angles.rotation_from_angles(calibration.start_angles_rad, self._side)
        self._rotation, self._translation = calibration.rotation_w0_cam, calibration.translation_w0_cam_m
        self._palm = np.array(calibration.clicks.protocol.palm)
        self._hand = measure_hand(calibration, camera, settings.palm)
        self._motion = PaperMotion(settings, self._hand.joint_count)
        self._markers = len(calibration.clicks.protocol.markers)
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self.begin_at_neutral()

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        self._state = self._motion.neutral_state()
        self._time_s: float | None = None
        self._last_seen_s = -np.inf
        self._is_waiting = False

    @property
    def is_lost(self) -> bool:
        return self._is_waiting

    def predict_measurement(self, timestamp_s: float) -> None:
        """Return None: the papers search every frame as if it were the first."""

    def is_search_incomplete(self, blobs: Detections) -> bool:
        """Return False: no search is narrowed."""
        return False

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Predict, associate, update; return the frame's result."""
        row = self._track(index, timestamp_s, detections, dropped_before)
        if row is not None:
            return row
        self.begin_at_neutral()
        self._is_waiting = True
        self._record_assignment(timestamp_s, np.full(self._markers, -1))
        unknown = nan_kinematics(self._hand.joint_count, self._markers)
        return build_lost_frame(
            index, timestamp_s, unknown, self._markers, detections, dropped_before, self._direct_share()
        )

    def _track(
        self, index: int, timestamp_s: float, detections: Detections, dropped_before: int
    ) -> TrackedFrame | None:
        """Return the row of a frame; None where the hand is lost."""
        settings, camera = self.settings, self._camera
        dt_s = 0.0 if self._time_s is None or self._is_waiting else timestamp_s - self._time_s
        if dt_s > settings.lost_after_s:
            return None
        pixel, resolution_px2 = camera.undistort(detections.pixel), float(camera.width_px * camera.height_px)
        try:
            predicted = predict_state(
                self._state, self._motion.noise_covariance, self._motion.build_transition(dt_s), settings.scaling
            )
            # (2): pixels (P, 2 M) of all markers for the sigma points
            projected = camera.project(self._discs_cam_m(predicted.points)).reshape(len(predicted.points), -1)
            outputs = predict_outputs(predicted, projected)
            predicted_px, predicted_cov_px2 = self._predict_markers(outputs)
            assigned = assign_blobs(
                log_posteriors(pixel, predicted_px, predicted_cov_px2, settings.clutter_prior, resolution_px2)
            )
            # The visible markers V(t) and the blobs associated with them.
            used = np.flatnonzero(assigned >= 0)
            rows = (2 * used[:, None] + np.arange(2)).ravel()
            visible = PredictedOutputs(
                outputs.mean[rows], outputs.covariance[np.ix_(rows, rows)], outputs.cross_covariance[:, rows]
            )
            noise = np.full(rows.size, settings.pixel_sd_px**2)
            state, nis = update_state(predicted, visible, pixel[assigned[used]].ravel(), noise)
        except np.linalg.LinAlgError:
            return None
        mean, variance = state.mean, state.covariance.diagonal()
        is_sane = np.isfinite(mean).all() and np.isfinite(variance).all() and (variance > 0.0).all()
        if not is_sane or np.abs(mean[EULER.start :]).max() >= _MAX_ANGLE_RAD:
            return None
        palm_count = int(np.count_nonzero(assigned[self._palm] >= 0))
        if self._is_waiting and palm_count < self._palm.size:
            return None
        if palm_count >= MIN_PALM_MARKERS or self._time_s is None:
            self._last_seen_s = timestamp_s
        if timestamp_s - self._last_seen_s > settings.lost_after_s:
            return None
        self._is_waiting, self._time_s, self._state = False, timestamp_s, state
        self._record_assignment(timestamp_s, assigned)
        measured_px, measured_depth_m = np.full((self._markers, 2), np.nan), np.full(self._markers, np.nan)
        measured_px[used], measured_depth_m[used] = detections.pixel[assigned[used]], detections.depth_m[assigned[used]]
        return TrackedFrame(
            index=index,
            timestamp_s=timestamp_s,
            status=TrackStatus.TRACKED if palm_count >= MIN_PALM_MARKERS else TrackStatus.PREDICTED,
            kinematics=self._read_kinematics(state),
            marker_position_cam_m=self._discs_cam_m(mean[None])[0],
            marker_predicted_px=camera.distort(predicted_px),
            marker_measured_px=measured_px,
            marker_measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._direct_share(),
            nis=nis,
            nis_dof=2 * used.size,
        )

    def _discs_cam_m(self, points: FloatArray) -> FloatArray:
        """Return markers (P, M, 3) in camera axes for states (P, n): g_w0c g(t) T_mi,w(Theta)."""
        discs_w0 = self._hand.discs_m(points[:, JOINTS]) @ np.swapaxes(rotation_from_euler(points[:, EULER]), -1, -2)
        out = (discs_w0 + points[:, None, POSITION]) @ self._rotation.T + self._translation
        out[..., 2] = np.maximum(out[..., 2], _MIN_DEPTH_M)
        return out

    def _predict_markers(self, seen: PredictedOutputs) -> tuple[FloatArray, FloatArray]:
        """Return (10) and (11) of every marker: (M, 2) and (M, 2, 2)."""
        marker = np.arange(self._markers)
        own = seen.covariance.reshape(self._markers, 2, self._markers, 2)[marker, :, marker, :]
        return seen.mean.reshape(-1, 2), own + self.settings.pixel_sd_px**2 * np.eye(2)

    def _read_kinematics(self, state: Gaussian) -> KinematicState:
        mean, covariance = state.mean, state.covariance
        rotation = rotation_from_euler(mean[EULER])
        wrist_rotation = self._start @ rotation
        angles, by_turn, zyz = clinical_angles.compute_wrist_angles(wrist_rotation, self._side)
        by_euler = by_turn @ body_rate_matrix(mean[EULER])
        joints_rad = mean[JOINTS]
        positions_m = self._hand.discs_m(mean[None, JOINTS])[0] @ rotation.T + mean[POSITION]
        return KinematicState(
            position_m=mean[POSITION],
            velocity_m_s=mean[VELOCITY],
            w0_turn_rad=so3.log(self._start.T),
            rotation_w2_w0=wrist_rotation,
            angular_velocity_rad_s=np.full(3, np.nan),  # white in (1): there is none to report
            angles_rad=angles,
            angles_sd_rad=np.sqrt(np.vecdot(by_euler @ covariance[EULER, EULER], by_euler)),
            angles_zyz_rad=zyz,
            joint_angles_rad=joints_rad,
            joint_angles_sd_rad=np.sqrt(covariance.diagonal()[JOINTS]),
            joint_velocity_rad_s=np.full(joints_rad.size, np.nan),
            joint_position_m=positions_m if joints_rad.size else np.empty((0, 3)),
        )

    def _record_assignment(self, timestamp_s: float, assigned: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, assigned))
        while self._recent[0][0] < timestamp_s - _SHARE_WINDOW_S:
            self._recent.popleft()

    def _direct_share(self) -> FloatArray:
        """Return the share (3,) of the palm's markers measured over the last second.

        Of a whole hand, the share (J,) of the frames with both discs at a joint.
        """
        is_measured = np.array([assigned for _, assigned in self._recent]) >= 0
        if self._hand.anatomy is None:
            return np.full(3, is_measured[:, self._palm].mean())
        return np.asarray(is_measured[:, _JOINT_MARKERS].all(axis=2).mean(axis=0))


_JOINT_MARKERS = np.array([[SITES.index(disc) for disc in markers_at_joint(name)] for name in joint_angle_names()])


@dataclass(frozen=True, slots=True)
class PaperTrackSettings(TrackSettings):
    """Settings of both papers' filter in ZYX, which uses nothing of ``tracker`` and does not smooth."""

    paper: PaperSettings = field(default_factory=PaperSettings)

    @classmethod
    def from_base(cls, base: TrackSettings, paper: PaperSettings) -> Self:
        """Return settings with this filter in place of Carpus' own."""
        return cls(base.detection, base.calibration, base.tracker, base.smooth, paper)

    @property
    def dip_free(self) -> bool:
        return False

    @property
    def uses_depth(self) -> bool:
        return False

    def build_tracker(
        self, calibration: Calibration, camera: Camera, learnt: NeutralNoise
    ) -> tuple[PaperTracker, None]:
        return PaperTracker(calibration, camera, self.paper), None

    def adapt_calibration(self, calibration: Calibration, camera: Camera) -> Calibration:
        return calibrate_as_written(calibration, camera, self.paper.palm)

    def adapt_stored_calibration(self, session: Session) -> Calibration:
        before = settings_from_json(session.header.parameters)
        calibration = session.calibration
        if before is not None and isinstance(before.settings, PaperTrackSettings):
            if before.settings.paper.palm == self.paper.palm:
                return calibration
            calibration = with_w0_from_markers(calibration)
        return self.adapt_calibration(calibration, session.camera)


def settings_from_json(parameters: str) -> StoredSettings | None:
    """Return the settings in a session's parameters, of whichever filter; None where there are none."""
    return stored_settings.settings_from_json(
        parameters, PaperTrackSettings if is_of_other_filter(parameters) else TrackSettings
    )
