"""Times one peer beside the plain filter, inside that peer's own environment; the figures go out as one line of JSON.

``python -m tests.bench.peer_run filters`` or ``python -m tests.bench.peer_run mediapipe PICTURES.npz``. Runs with no
more than NumPy and the peer itself: a peer pins what Carpus has outgrown.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator
from datetime import datetime, timedelta
from typing import Any

import numpy as np

from tests.bench import reference

STEPS, SETTLED = 150, 30
DT_S = 1.0 / 30.0
_START_VARIANCE = np.r_[np.full(3, 1e-5), np.full(3, 1e-2), np.full(3, 1e-3), np.full(17, 1e-2)]
_ALPHA, _BETA, _KAPPA = 0.5, 2.0, 0.0
_FOLLOWS_DEG = 12.0
"""A filter whose joints err by more than this does another job."""


def process_noise() -> np.ndarray:
    """The yardstick's noise per step as an additive covariance (26, 26)."""
    gain = np.zeros((reference.STATE, reference.NOISE))
    gain[0:3, 0:3], gain[3:6, 0:3] = 0.5 * DT_S**2 * np.eye(3), DT_S * np.eye(3)
    gain[6:, 3:] = DT_S * np.eye(20)
    own = np.r_[np.full(3, 2.0), np.full(3, 1.5), np.full(17, 2.5)] ** 2
    return gain * own @ gain.T + 1e-12 * np.eye(reference.STATE)


def moved(states: np.ndarray) -> np.ndarray:
    """States (P, 26) one frame later, without noise."""
    out = states.copy()
    out[:, 0:3] += DT_S * states[:, 3:6]
    return out


class StoneSoup:
    """Its unscented predictor and updater; the model sees all points at once."""

    def __init__(self) -> None:
        from stonesoup.models.measurement.nonlinear import NonLinearGaussianMeasurement
        from stonesoup.models.transition.base import TransitionModel
        from stonesoup.predictor.kalman import UnscentedKalmanPredictor
        from stonesoup.types.array import CovarianceMatrix, StateVector, StateVectors
        from stonesoup.types.detection import Detection
        from stonesoup.types.hypothesis import SingleHypothesis
        from stonesoup.types.state import GaussianState
        from stonesoup.updater.kalman import UnscentedKalmanUpdater

        noise = CovarianceMatrix(process_noise())

        class Moving(TransitionModel):  # type: ignore[misc]
            @property
            def ndim_state(self) -> int:
                return reference.STATE

            def function(self, state: Any, *_: Any, **__: Any) -> Any:
                return moved(np.asarray(state.state_vector, dtype=float).T).T.view(StateVectors)

            def covar(self, **_: Any) -> Any:
                return noise

            def rvs(self, **_: Any) -> Any:
                raise NotImplementedError

            def pdf(self, *_: Any, **__: Any) -> Any:
                raise NotImplementedError

        class Seeing(NonLinearGaussianMeasurement):  # type: ignore[misc]
            @property
            def ndim_meas(self) -> int:
                return 2 * reference.MARKERS

            def function(self, state: Any, *_: Any, **__: Any) -> Any:
                return reference.measured(np.asarray(state.state_vector, dtype=float).T).T.view(StateVectors)

            def rvs(self, **_: Any) -> Any:
                raise NotImplementedError

        pixels = CovarianceMatrix(reference.PIXEL_VARIANCE * np.eye(2 * reference.MARKERS))
        self._seeing = Seeing(ndim_state=reference.STATE, mapping=tuple(range(9)), noise_covar=pixels)
        spread = {"alpha": _ALPHA, "beta": _BETA, "kappa": _KAPPA}
        self._predictor = UnscentedKalmanPredictor(Moving(), **spread)
        self._updater = UnscentedKalmanUpdater(self._seeing, **spread)
        self._detection, self._hypothesis, self._vector = Detection, SingleHypothesis, StateVector
        self._time = datetime(2020, 1, 1)
        start = reference.motion(0.0)[:, None]
        self._state = GaussianState(StateVector(start), CovarianceMatrix(np.diag(_START_VARIANCE)), self._time)

    def step(self, pixel: np.ndarray) -> np.ndarray:
        self._time += timedelta(seconds=DT_S)
        ahead = self._predictor.predict(self._state, timestamp=self._time)
        seen = self._detection(self._vector(pixel[:, None]), timestamp=self._time, measurement_model=self._seeing)
        self._state = self._updater.update(self._hypothesis(ahead, seen))
        return np.asarray(self._state.mean, dtype=float).ravel()


class FilterPy:
    """Its unscented Kalman filter; the model is called for every point."""

    def __init__(self) -> None:
        from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter

        points = MerweScaledSigmaPoints(reference.STATE, _ALPHA, _BETA, _KAPPA)
        self._filter = UnscentedKalmanFilter(
            reference.STATE,
            2 * reference.MARKERS,
            DT_S,
            hx=lambda x: reference.measured(x[None])[0],
            fx=lambda x, _dt: moved(x[None])[0],
            points=points,
        )
        self._filter.x = reference.motion(0.0)
        self._filter.P = np.diag(_START_VARIANCE)
        self._filter.Q = process_noise()
        self._filter.R = reference.PIXEL_VARIANCE * np.eye(2 * reference.MARKERS)

    def step(self, pixel: np.ndarray) -> np.ndarray:
        self._filter.predict()
        self._filter.update(pixel)
        return np.asarray(self._filter.x)


class Plain:
    """The yardstick."""

    def __init__(self) -> None:
        self._filter = reference.ReferenceFilter()

    def step(self, pixel: np.ndarray) -> np.ndarray:
        self._filter.step(pixel, DT_S)
        return self._filter.mean


def timed(work: Callable[[Any], Any], given: Any) -> tuple[float, Any]:
    """CPU milliseconds of the whole process, as a peer may work in threads of its own; and what came of it."""
    begin = time.process_time()
    result = work(given)
    return 1e3 * (time.process_time() - begin), result


def filters() -> Iterator[dict[str, Any]]:
    """The three filters on the same pixels, in turn within every step."""
    rng = np.random.default_rng(0)
    running: dict[str, Any] = {"plain": Plain(), "Stone Soup": StoneSoup(), "filterpy": FilterPy()}
    spent: dict[str, list[float]] = {name: [] for name in running}
    error: dict[str, list[float]] = {name: [] for name in running}
    for k in range(1, STEPS + SETTLED):
        truth = reference.motion(k * DT_S)
        pixel = reference.measured(truth[None])[0] + rng.normal(0.0, 1.0, 2 * reference.MARKERS)
        for name, one in running.items():
            ms, mean = timed(one.step, pixel)
            spent[name].append(ms)
            error[name].append(float(np.degrees(np.sqrt(np.mean((mean[9:] - truth[9:]) ** 2)))))
    for name in running:
        rms = float(np.sqrt(np.mean(np.square(error[name][SETTLED:]))))
        note = f"joints within {rms:.1f} degrees RMS" if rms < _FOLLOWS_DEG else f"does not follow: {rms:.0f} degrees"
        yield {"name": name, "cpu_ms": spent[name][SETTLED:], "note": note}


def mediapipe(pictures: str) -> Iterator[dict[str, Any]]:
    """MediaPipe Hands on pictures of a plain hand, the plain filter stepped after every one."""
    import mediapipe as mp

    color = np.load(pictures)["color_rgb"]
    rng, spent = np.random.default_rng(0), []
    for complexity in (0, 1):
        plain = Plain()
        hands = mp.solutions.hands.Hands(static_image_mode=False, max_num_hands=1, model_complexity=complexity)
        times, seen = [], 0
        for k, picture in enumerate(color):
            ms, found = timed(hands.process, picture)
            times.append(ms)
            seen += found.multi_hand_landmarks is not None
            pixel = reference.measured(reference.motion((k + 1) * DT_S)[None])[0] + rng.normal(0.0, 1.0, 42)
            spent.append(timed(plain.step, pixel)[0])
        note = f"picture to 21 points, no angles; hand found in {100 * seen / len(color):.0f} % of plain pictures"
        yield {"name": f"MediaPipe Hands {mp.__version__}, complexity {complexity}", "cpu_ms": times[5:], "note": note}
    yield {"name": "plain", "cpu_ms": spent[5:], "note": ""}


def main() -> int:
    which = sys.argv[1]
    rows = list(filters() if which == "filters" else mediapipe(sys.argv[2]))
    sys.stdout.write(json.dumps(rows) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
