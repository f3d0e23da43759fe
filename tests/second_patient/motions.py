"""What the second patient does: trajectories of its own, smooth to the third derivative, each begun by a still hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray
from tests.second_patient.skeleton import Posture

STILL_S = 0.9
"""The hand lies still so long for the clicks."""
SECONDS = 5.6


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


def row_named(name: str) -> Row:
    """The row of that name; raises ValueError with the names there are."""
    for row in ROWS:
        if row.name == name:
            return row
    raise ValueError(f"no row {name!r}; there are: {', '.join(row.name for row in ROWS)}")


Curve = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion of one seed: ``at`` gives the posture at times (N,) in seconds."""

    at: Callable[[FloatArray], Posture]


def ease(x: FloatArray) -> FloatArray:
    """From 0 to 1 with speed, acceleration and jerk zero at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3))


def interpolate_rests(times_s: list[float], values: list[float]) -> Curve:
    """A curve that rests at each value at its time."""

    def curve(t: FloatArray) -> FloatArray:
        out = np.full(np.shape(t), float(values[0]))
        for i in range(len(times_s) - 1):
            out += (values[i + 1] - values[i]) * ease((t - times_s[i]) / (times_s[i + 1] - times_s[i]))
        return out

    return curve


def _nothing(t: FloatArray) -> FloatArray:
    return np.zeros(np.shape(t))


def make_motion(name: str, seed: int) -> Motion:
    """The motion ``name`` as the person of a seed does it."""
    rng = np.random.default_rng([seed, 1409])
    vary = lambda low, high: float(rng.uniform(low, high))  # noqa: E731
    lazy = np.array([vary(6, 16), vary(2, 10), vary(2, 8), vary(-2, 3), vary(4, 12)])
    bent = np.array([[vary(-2, 2), vary(1, 8), vary(1, 8)] for _ in range(4)])
    end = vary(0.6, 0.72)
    hold = np.array([vary(0.9, 1.08) for _ in range(4)])
    shake = [(vary(0.03, 0.12), vary(1.4, 4.5), vary(0, 6.3)) for _ in range(6)]
    start = STILL_S + vary(0.0, 0.15)
    pace = vary(0.94, 1.06)
    at = lambda *seconds: [start + pace * s for s in seconds]  # noqa: E731
    wrist: list[Curve] = [_nothing, _nothing, _nothing]
    place: list[Curve] = [_nothing, _nothing, _nothing]
    mcp: Curve = _nothing
    pip: Curve = _nothing
    spread: Curve = _nothing
    cup: Curve = _nothing
    roll: Curve = interpolate_rests(at(0.2, 2.6, 4.6), [0.0, vary(-2.5, 2.5), vary(-1.5, 1.5)])
    thumb = [_nothing] * 5
    if name == "tenodesis":
        down, back, gain = vary(18, 28), vary(36, 46), vary(0.8, 1.0)
        wrist[1] = interpolate_rests(at(0.0, 0.9, 2.1, 3.2, 4.4), [0.0, down, -back, down * 0.8, -back * 0.9])
        wrist[0] = interpolate_rests(at(0.0, 1.6, 3.0, 4.4), [0.0, vary(-3, 3), vary(-3, 3), 0.0])
        # Fingers follow the wrist: the long tendons are as long as they are.
        bend = wrist[1]
        mcp = lambda t: gain * np.maximum(-bend(t), -6.0)  # noqa: E731
        pip = lambda t: gain * np.maximum(-bend(t), -6.0)  # noqa: E731
        cup = lambda t: 0.35 * np.clip(-bend(t) / 45.0, 0.0, 1.0)  # noqa: E731
    elif name == "held_grip":
        mcp, pip = interpolate_rests(at(0.0, 0.9, 4.0, 4.7), [0.0, vary(48, 55), vary(48, 55), 4.0]), interpolate_rests(
            at(0.0, 0.9, 4.0, 4.7), [0.0, vary(40, 55), vary(40, 55), 3.0])  # fmt: skip
        cup = interpolate_rests(at(0.0, 0.9, 4.0, 4.7), [0.0, 0.55, 0.6, 0.05])
        out, inn = vary(14, 19), vary(20, 27)
        wrist[0] = interpolate_rests(at(1.0, 1.7, 2.5, 3.2, 4.0), [0.0, out, -inn, out, 0.0])
    elif name == "power_grip":
        mcp, pip = interpolate_rests(at(0.0, 1.0, 3.9, 4.7), [0.0, vary(66, 78), vary(70, 80), 5.0]), interpolate_rests(
            at(0.0, 1.0, 3.9, 4.7), [0.0, vary(70, 88), vary(75, 90), 5.0])  # fmt: skip
        cup = interpolate_rests(at(0.1, 1.1, 3.8, 4.7), [0.0, 1.0, 1.0, 0.05])
        wrist[1] = interpolate_rests(at(0.2, 1.2, 2.0, 2.9, 3.8, 4.6), [0.0, -18.0, 8.0, -24.0, -10.0, 0.0])
        wrist[0] = interpolate_rests(at(0.8, 1.8, 2.9, 4.0), [0.0, 7.0, -10.0, 0.0])
        thumb = [interpolate_rests(at(0.1, 1.2, 3.8, 4.7), [0.0, v, v, 0.0]) for v in (-8.0, 22.0, 18.0, 2.0, 25.0)]
    elif name == "pronosupination":
        a, b = vary(28, 36), vary(24, 34)
        wrist[2] = interpolate_rests(at(0.0, 1.0, 2.3, 3.5, 4.5), [0.0, a, -b, a * 0.8, 0.0])
        wrist[1] = interpolate_rests(at(0.0, 1.0, 2.3, 4.5), [0.0, vary(-4, 4), vary(-4, 4), 0.0])
        roll = _nothing
    elif name == "rest_fingers":
        a = vary(38, 52)
        mcp = pip = interpolate_rests(at(0.0, 0.9, 1.8, 2.8, 3.8), [0.0, a, 0.0, a, 0.0])
        cup = interpolate_rests(at(0.0, 0.9, 1.8, 2.8, 3.8), [0.0, 0.35, 0.0, 0.35, 0.0])
    elif name == "fingers45":
        a = vary(43, 47)
        mcp = interpolate_rests(at(0.0, 1.0, 1.5, 2.5, 3.4, 4.4), [0.0, a, a, 0.0, a, 0.0])
        pip = interpolate_rests(at(0.0, 1.0, 1.5, 2.5, 3.4, 4.4), [0.0, a * 0.45, a * 0.45, 0.0, a * 0.45, 0.0])
        cup = interpolate_rests(at(0.0, 1.0, 1.5, 2.5, 3.4, 4.4), [0.0, 0.3, 0.3, 0.0, 0.3, 0.0])
        wrist[1] = interpolate_rests(at(0.3, 1.6, 3.6), [0.0, vary(-3, 3), 0.0])
    elif name == "grasp":
        wide = interpolate_rests(at(0.0, 1.0, 1.7, 2.9, 3.6, 4.4), [0.4, 1.0, 0.1, 0.1, 0.9, 0.4])
        mcp, pip = (lambda t: 14.0 + 38.0 * (1.0 - wide(t)) - 52.0 * _flat(t, start)), (
            lambda t: 18.0 + 40.0 * (1.0 - wide(t)) - 58.0 * _flat(t, start))  # fmt: skip
        cup = lambda t: 0.7 * (1.0 - wide(t)) * (1.0 - _flat(t, start))  # noqa: E731
        spread = lambda t: 3.0 * wide(t) * (1.0 - _flat(t, start))  # noqa: E731
        thumb = [
            lambda t: 8.0 * wide(t) * (1.0 - _flat(t, start)),
            lambda t: (22.0 + 14.0 * wide(t)) * (1.0 - _flat(t, start)),
            lambda t: 16.0 * (1.0 - wide(t)) * (1.0 - _flat(t, start)),
            _nothing,
            lambda t: 20.0 * (1.0 - wide(t)) * (1.0 - _flat(t, start)),
        ]
        wrist[1] = interpolate_rests(at(0.0, 1.0, 2.2, 3.2, 4.5), [0.0, -14.0, -24.0, -18.0, -4.0])
        wrist[0] = interpolate_rests(at(0.4, 1.6, 2.6, 4.2), [0.0, -8.0, 6.0, 0.0])
        wrist[2] = interpolate_rests(at(0.0, 1.2, 3.2, 4.5), [0.0, 16.0, 20.0, 3.0])
        place[0] = interpolate_rests(at(0.0, 1.4, 3.0, 4.5), [0.0, 0.045, 0.045, 0.005])
        place[2] = interpolate_rests(at(0.0, 1.4, 3.0, 4.5), [0.0, 0.02, 0.03, 0.0])
    elif name == "mixed":
        wrist[1] = interpolate_rests(at(0.0, 0.9, 2.0, 3.1, 4.3), [0.0, 30.0, -26.0, 22.0, 0.0])
        wrist[0] = interpolate_rests(at(0.3, 1.3, 2.4, 3.6, 4.5), [0.0, 12.0, -16.0, 10.0, 0.0])
        wrist[2] = interpolate_rests(at(0.2, 1.5, 2.9, 4.4), [0.0, -14.0, 18.0, 0.0])
        roll = _nothing
    else:
        raise ValueError(f"no motion {name!r}")

    def posture(t: FloatArray) -> Posture:
        t = np.asarray(t, dtype=np.float64)
        trembles = [a * np.sin(2.0 * np.pi * f * t + p) for a, f, p in shake]
        angles = np.stack([curve(t) + tremble for curve, tremble in zip(wrist, trembles, strict=False)], axis=1)
        angles[:, 1] += _LAID_DEG
        where = np.stack([curve(t) for curve in place], axis=1)
        where += 0.0008 * np.stack(trembles[3:], axis=1)
        q = np.empty((len(t), 21))
        q[:, :5] = np.stack([lazy[i] + thumb[i](t) for i in range(5)], axis=1)
        for ray in range(4):
            one = q[:, 5 + 4 * ray : 9 + 4 * ray]
            flex, middle = hold[ray] * mcp(t), hold[3 - ray] * pip(t)
            one[:, 0] = bent[ray, 0] + spread(t) * (1.0, 0.0, -1.0, -2.0)[ray]
            # A bent finger cannot be spread: its side ligaments are taut.
            one[:, 0] *= np.cos(np.radians(np.clip(bent[ray, 1] + flex, 0.0, 85.0)))
            one[:, 1], one[:, 2] = bent[ray, 1] + flex, bent[ray, 2] + middle
            one[:, 3] = end * one[:, 2]
        return Posture(np.radians(angles), where, np.radians(q), np.clip(cup(t), 0.0, 1.0), np.radians(roll(t)))

    return Motion(posture)


_LAID_DEG = -6.0
"""A hand on its wedge lies a little bent back."""


def _flat(t: FloatArray, start: float) -> FloatArray:
    """1 while the hand lies flat for the clicks and at the end, 0 while it grasps."""
    return np.asarray(1.0 - ease((t - start) / 0.8) + ease((t - start - 4.0) / 0.7))
