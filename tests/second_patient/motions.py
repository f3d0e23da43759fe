"""What the second patient does: trajectories of its own, smooth to the third derivative, each begun by a still hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray
from tests.second_patient.person import Posture

STILL_S = 0.9
"""The hand lies still so long for the clicks."""
SECONDS = 5.6
_LAID_DEG = -6.0
"""A hand on its wedge lies a little bent back."""


@dataclass(frozen=True, slots=True)
class Row:
    """A recording that is asked for by ``name``: protocol, motion, and whether skin and palm stand still."""

    name: str
    protocol: str
    motion: str
    rigid: bool = False


ROWS = (
    Row("tenodesis", "wrist6", "tenodesis"),
    Row("grip held while deviating", "wrist6", "held_grip"),
    Row("power grip, cupped palm", "wrist6", "power_grip"),
    Row("pro/supination, rigid palm", "wrist6", "pronosupination", rigid=True),
    Row("rest, fingers open and close", "wrist6", "rest_fingers"),
    Row("wrist, nothing glides", "wrist6", "mixed", rigid=True),
    Row("hand: fingers to 45 and back", "hand21", "fingers45"),
    Row("hand: power grip, cupped palm", "hand21", "power_grip"),
    Row("hand: grasping", "hand21", "grasp"),
    Row("hand: tenodesis", "hand21", "tenodesis"),
    Row("hand: wrist, nothing glides", "hand21", "mixed", rigid=True),
)

Curve = Callable[[FloatArray], FloatArray]
Motion = Callable[[FloatArray], Posture]
"""The posture at times (N,) in seconds."""


def ease(x: FloatArray) -> FloatArray:
    """From 0 to 1 with speed, acceleration and jerk zero at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3))


def _nothing(t: FloatArray) -> FloatArray:
    return np.zeros(np.shape(t))


def make_motion(name: str, seed: int) -> Motion:
    """The motion ``name`` as the person of a seed does it."""
    rng = np.random.default_rng([seed, 1409])

    def vary(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def rests(at_s: tuple[float, ...], *values: float) -> Curve:
        """A curve that rests at each value at its time after the still hand, at the person's pace."""
        times_s = [start + pace * s for s in at_s]

        def curve(t: FloatArray) -> FloatArray:
            out = np.full(np.shape(t), float(values[0]))
            for i in range(len(times_s) - 1):
                out += (values[i + 1] - values[i]) * ease((t - times_s[i]) / (times_s[i + 1] - times_s[i]))
            return out

        return curve

    lazy = rng.uniform([6, 2, 2, -2, 4], [16, 10, 8, 3, 12])
    bent = rng.uniform([-2, 1, 1], [2, 8, 8], (4, 3))
    end = vary(0.6, 0.72)
    hold = rng.uniform(0.9, 1.08, 4)
    shake = rng.uniform([0.03, 1.4, 0], [0.12, 4.5, 6.3], (6, 3))
    start, pace = STILL_S + vary(0.0, 0.15), vary(0.94, 1.06)
    roll = rests((0.2, 2.6, 4.6), 0.0, vary(-2.5, 2.5), vary(-1.5, 1.5))
    deviation, flexion, supination, forward, up = (_nothing,) * 5
    mcp, pip, spread, cup, thumb = _nothing, _nothing, _nothing, _nothing, [_nothing] * 5
    if name == "tenodesis":
        down, back, gain = vary(18, 28), vary(36, 46), vary(0.8, 1.0)
        flexion = rests((0.0, 0.9, 2.1, 3.2, 4.4), 0.0, down, -back, down * 0.8, -back * 0.9)
        deviation = rests((0.0, 1.6, 3.0, 4.4), 0.0, vary(-3, 3), vary(-3, 3), 0.0)
        # Fingers follow the wrist: the long tendons are as long as they are.
        mcp = pip = lambda t: gain * np.maximum(-flexion(t), -6.0)
        cup = lambda t: 0.35 * np.clip(-flexion(t) / 45.0, 0.0, 1.0)  # noqa: E731
    elif name == "held_grip":
        at_s = (0.0, 0.9, 4.0, 4.7)
        mcp, pip = (rests(at_s, 0.0, vary(low, 55), vary(low, 55), last) for low, last in ((48, 4.0), (40, 3.0)))
        cup = rests(at_s, 0.0, 0.55, 0.6, 0.05)
        out, inn = vary(14, 19), vary(20, 27)
        deviation = rests((1.0, 1.7, 2.5, 3.2, 4.0), 0.0, out, -inn, out, 0.0)
    elif name == "power_grip":
        at_s = (0.0, 1.0, 3.9, 4.7)
        mcp = rests(at_s, 0.0, vary(66, 78), vary(70, 80), 5.0)
        pip = rests(at_s, 0.0, vary(70, 88), vary(75, 90), 5.0)
        cup = rests((0.1, 1.1, 3.8, 4.7), 0.0, 1.0, 1.0, 0.05)
        flexion = rests((0.2, 1.2, 2.0, 2.9, 3.8, 4.6), 0.0, -18.0, 8.0, -24.0, -10.0, 0.0)
        deviation = rests((0.8, 1.8, 2.9, 4.0), 0.0, 7.0, -10.0, 0.0)
        thumb = [rests((0.1, 1.2, 3.8, 4.7), 0.0, v, v, 0.0) for v in (-8.0, 22.0, 18.0, 2.0, 25.0)]
    elif name == "pronosupination":
        a, b = vary(28, 36), vary(24, 34)
        supination = rests((0.0, 1.0, 2.3, 3.5, 4.5), 0.0, a, -b, a * 0.8, 0.0)
        flexion = rests((0.0, 1.0, 2.3, 4.5), 0.0, vary(-4, 4), vary(-4, 4), 0.0)
        roll = _nothing
    elif name == "rest_fingers":
        a, at_s = vary(38, 52), (0.0, 0.9, 1.8, 2.8, 3.8)
        mcp = pip = rests(at_s, 0.0, a, 0.0, a, 0.0)
        cup = rests(at_s, 0.0, 0.35, 0.0, 0.35, 0.0)
    elif name == "fingers45":
        a = vary(43, 47)
        mcp, pip, cup = (
            rests((0.0, 1.0, 1.5, 2.5, 3.4, 4.4), 0.0, most, most, 0.0, most, 0.0) for most in (a, a * 0.45, 0.3)
        )
        flexion = rests((0.3, 1.6, 3.6), 0.0, vary(-3, 3), 0.0)
    elif name == "grasp":
        wide = rests((0.0, 1.0, 1.7, 2.9, 3.6, 4.4), 0.4, 1.0, 0.1, 0.1, 0.9, 0.4)

        def grasping(t: FloatArray) -> FloatArray:
            """0 while the hand lies flat for the clicks and at the end, 1 while it grasps."""
            return 1.0 - np.asarray(1.0 - ease((t - start) / 0.8) + ease((t - start - 4.0) / 0.7))

        mcp = lambda t: 14.0 + 38.0 * (1.0 - wide(t)) - 52.0 * (1.0 - grasping(t))  # noqa: E731
        pip = lambda t: 18.0 + 40.0 * (1.0 - wide(t)) - 58.0 * (1.0 - grasping(t))  # noqa: E731
        cup = lambda t: 0.7 * (1.0 - wide(t)) * grasping(t)  # noqa: E731
        spread = lambda t: 3.0 * wide(t) * grasping(t)  # noqa: E731
        by_width = ((0.0, 8.0), (22.0, 14.0), (16.0, -16.0), (0.0, 0.0), (20.0, -20.0))
        thumb = [lambda t, of=of: (of[0] + of[1] * wide(t)) * grasping(t) for of in by_width]
        flexion = rests((0.0, 1.0, 2.2, 3.2, 4.5), 0.0, -14.0, -24.0, -18.0, -4.0)
        deviation = rests((0.4, 1.6, 2.6, 4.2), 0.0, -8.0, 6.0, 0.0)
        supination = rests((0.0, 1.2, 3.2, 4.5), 0.0, 16.0, 20.0, 3.0)
        forward = rests((0.0, 1.4, 3.0, 4.5), 0.0, 0.045, 0.045, 0.005)
        up = rests((0.0, 1.4, 3.0, 4.5), 0.0, 0.02, 0.03, 0.0)
    elif name == "mixed":
        flexion = rests((0.0, 0.9, 2.0, 3.1, 4.3), 0.0, 30.0, -26.0, 22.0, 0.0)
        deviation = rests((0.3, 1.3, 2.4, 3.6, 4.5), 0.0, 12.0, -16.0, 10.0, 0.0)
        supination = rests((0.2, 1.5, 2.9, 4.4), 0.0, -14.0, 18.0, 0.0)
        roll = _nothing
    else:
        raise ValueError(f"no motion {name!r}")

    def posture(t: FloatArray) -> Posture:
        t = np.asarray(t, dtype=np.float64)
        trembles = [a * np.sin(2.0 * np.pi * f * t + p) for a, f, p in shake]
        wrist = [curve(t) + tremble for curve, tremble in zip((deviation, flexion, supination), trembles, strict=False)]
        angles = np.stack(wrist, axis=1)
        angles[:, 1] += _LAID_DEG
        where = np.stack((forward(t), _nothing(t), up(t)), axis=1) + 0.0008 * np.stack(trembles[3:], axis=1)
        q = np.empty((len(t), 21))
        q[:, :5] = np.stack([lazy[i] + thumb[i](t) for i in range(5)], axis=1)
        for ray in range(4):
            one = q[:, 5 + 4 * ray : 9 + 4 * ray]
            one[:, 0] = bent[ray, 0] + spread(t) * (1.0, 0.0, -1.0, -2.0)[ray]
            one[:, 1], one[:, 2] = bent[ray, 1] + hold[ray] * mcp(t), bent[ray, 2] + hold[3 - ray] * pip(t)
            # A bent finger cannot be spread: its side ligaments are taut.
            one[:, 0] *= np.cos(np.radians(np.clip(one[:, 1], 0.0, 85.0)))
            one[:, 3] = end * one[:, 2]
        return Posture(np.radians(angles), where, np.radians(q), np.clip(cup(t), 0.0, 1.0), np.radians(roll(t)))

    return posture
