"""Looking back: equal to least squares over the whole sequence on a linear model, never less sure than the filter."""

from __future__ import annotations

import numpy as np
import pytest

from core.tracking import modes
from core.tracking.measurement import forecast, forecast_reduced, update
from core.tracking.modes import ModeBank
from core.tracking.smoother import FilterStep, smooth
from core.tracking.state import StateLayout
from core.tracking.unscented import Spread
from core.types import FloatArray
from tests.tracking.test_linear_oracle import JOINTS, NOISE, SHAPES, as_vector, by_hand, linear_view, start

LAYOUT = StateLayout(JOINTS, True, SHAPES)
STEPS = 12
Measured = list[tuple[FloatArray, FloatArray, FloatArray]]


def filtered(seed: int) -> tuple[list[FilterStep], FloatArray, FloatArray, list[float], Measured]:
    """A filtered linear sequence; start mean and covariance, time steps, and (H, y, R) of every step."""
    rng = np.random.default_rng(seed)
    view = linear_view(rng, 0.0)
    belief = start(LAYOUT, rng, yaw_rate=0.0)
    h = view.matrix(LAYOUT)
    mean, covariance = as_vector(belief, LAYOUT), belief.covariance
    x = mean + np.linalg.cholesky(covariance) @ rng.normal(size=mean.size)
    x[6:12] = 0.0
    bank, steps, times, measured = ModeBank.of(belief, 1), [], [0.0], []
    # The first frame is of the start's own time.
    dts = [0.0, *rng.uniform(0.01, 0.05, STEPS - 1)]
    for dt in dts:
        if dt > 0.0:
            ahead = forecast_reduced(bank, NOISE, np.ones(1), dt, LAYOUT, view, Spread())  # type: ignore[arg-type]
            f, q = by_hand(LAYOUT, dt)
            draw = np.linalg.eigh(q)
            push = draw[1] @ (np.sqrt(np.maximum(draw[0], 0.0)) * rng.normal(size=x.size))
            push[6:12] = 0.0
            x = f @ x + push
        else:
            ahead = forecast(bank, LAYOUT, view, Spread())  # type: ignore[arg-type]
        rows = np.sort(rng.choice(len(h), int(rng.integers(0, 8)), replace=False))
        noise = rng.uniform(0.05, 0.3, rows.size) ** 2
        y = h[rows] @ x + np.sqrt(noise) * rng.normal(size=rows.size)
        bank = modes.merged(update(ahead, rows, y, noise)[0], LAYOUT)
        times.append(times[-1] + dt)
        steps.append(FilterStep(times[-1], bank.nominal, 1.0, bool(steps)))
        measured.append((h[rows], y, noise))
    return steps, mean, covariance, dts, measured


def least_squares(
    mean: FloatArray, covariance: FloatArray, dts: list[float], measured: Measured
) -> tuple[FloatArray, FloatArray]:
    """All states at once: the joint Gaussian of the whole sequence, conditioned on all measurements."""
    n, count = mean.size, len(dts)
    means, cov = np.zeros((count, n)), np.zeros((count * n, count * n))
    means[0], cov[:n, :n] = mean, covariance
    for k in range(1, count):
        f, q = by_hand(LAYOUT, dts[k])
        means[k] = f @ means[k - 1]
        now, before = slice(k * n, (k + 1) * n), slice((k - 1) * n, k * n)
        cov[now, : k * n] = f @ cov[before, : k * n]
        cov[: k * n, now] = cov[now, : k * n].T
        cov[now, now] = f @ cov[before, before] @ f.T + q
    h = np.zeros((sum(len(y) for _, y, _ in measured), count * n))
    row = 0
    for k, (hk, y, _) in enumerate(measured):
        h[row : row + len(y), k * n : (k + 1) * n] = hk
        row += len(y)
    y = np.concatenate([y for _, y, _ in measured])
    r = np.diag(np.concatenate([noise for _, _, noise in measured]))
    gain = np.linalg.solve(h @ cov @ h.T + r, h @ cov).T
    flat = means.ravel()
    return (flat + gain @ (y - h @ flat)).reshape(count, n), cov - gain @ h @ cov


@pytest.mark.parametrize("seed", range(3))
def test_smoother_is_least_squares_over_the_whole_sequence(seed: int) -> None:
    steps, mean, covariance, dts, measured = filtered(seed)
    smoothed = smooth(steps, NOISE, LAYOUT)
    best, spread = least_squares(mean, covariance, dts, measured)
    n = LAYOUT.size
    moved = 0.0
    for k, belief in enumerate(smoothed):
        assert belief is not None
        own = spread[k * n : (k + 1) * n, k * n : (k + 1) * n]
        assert np.allclose(as_vector(belief, LAYOUT), best[k], atol=1e-7)
        assert np.allclose(belief.covariance, own, atol=1e-7)
        before = steps[k].belief
        assert before is not None
        moved = max(moved, float(np.abs(as_vector(before, LAYOUT) - best[k]).max()))
        # Never less sure than the filter in any direction.
        assert np.linalg.eigvalsh(before.covariance - belief.covariance).min() > -1e-9
    assert moved > 0.05, "looking back did change something"


def test_the_last_frame_is_the_filters() -> None:
    steps, *_ = filtered(0)
    last = smooth(steps, NOISE, LAYOUT)[-1]
    assert last is steps[-1].belief


def test_stretches_are_smoothed_each_by_itself() -> None:
    """Nothing is carried over a loss of the hand, nor over the place where the track began anew."""
    steps, *_ = filtered(1)
    whole = smooth(steps, NOISE, LAYOUT)
    broken = list(steps)
    broken[6] = FilterStep(steps[6].timestamp_s, None, 1.0, False)
    broken[7] = FilterStep(steps[7].timestamp_s, steps[7].belief, 1.0, False)
    first, second = smooth(broken[:6], NOISE, LAYOUT), smooth(broken[7:], NOISE, LAYOUT)
    together = smooth(broken, NOISE, LAYOUT)
    assert together[6] is None
    for found, alone in zip([*together[:6], *together[7:]], [*first, *second], strict=True):
        assert found is not None
        assert alone is not None
        assert np.array_equal(as_vector(found, LAYOUT), as_vector(alone, LAYOUT))
    assert whole[5] is not None
    assert first[5] is not None
    assert not np.allclose(as_vector(whole[5], LAYOUT), as_vector(first[5], LAYOUT))


def test_nothing_to_smooth() -> None:
    assert smooth([], NOISE, LAYOUT) == []
