"""Do the names of the discs on digits make fingers: lines that run outwards, side by side, and never cross?

A hand at its neutral pose has its fingers beside each other, straight or bent. Bending shortens a finger's line on the
picture but does not turn it aside; only wrong names let it turn back, cross another or jump to a neighbour.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.types import FloatArray, Side

_THUMB = 1


@dataclass(frozen=True, slots=True)
class FingerOrderSettings:
    """When lines of discs are no fingers.

    A line that turns aside by more than ``most_turn_deg`` at one disc is none; the thumb's base lies freely, up to
    ``most_thumb_turn_deg``. ``most_length`` and ``most_thumb_length``: longest pieces of a line, wrist to tip, over
    the length from WRIST to the middle knuckle; ``short`` ones on that scale have no direction worth judging.
    Faults count by ``length_weight`` for each such length too much, one for ``turn_deg`` too much and for a
    crossing, and ``order_weight`` for knuckles out of order. With ``clearly`` of them the names are doubted: two
    bent fingers may cross once (1) by themselves.
    """

    most_turn_deg: float = 50.0
    most_thumb_turn_deg: float = 75.0
    most_length: tuple[float, ...] = (1.25, 0.85, 0.62, 0.45)
    most_thumb_length: tuple[float, ...] = (0.6, 0.95, 0.75, 0.62)
    short: float = 0.08
    length_weight: float = 4.0
    turn_deg: float = 45.0
    order_weight: float = 1.5
    clearly: float = 1.2


@dataclass(frozen=True, slots=True)
class _Lines:
    """The lines that a protocol's discs make: ``chains`` by digit; pieces of them, and which pairs of pieces of
    different digits should not cross; the four ``knuckles``."""

    chains: dict[int, tuple[int, ...]]
    pieces: tuple[tuple[int, int, int], ...]
    beside: tuple[tuple[int, int], ...]
    knuckles: tuple[int, ...]


@lru_cache(maxsize=4)
def _lines_of(protocol: MarkerProtocol) -> _Lines:
    chains = protocol.chains
    pieces = tuple((a, b, digit) for digit, chain in chains.items() for a, b in pairwise(chain))
    beside = tuple(
        (i, j)
        for i, j in combinations(range(len(pieces)), 2)
        # Pieces of one finger, and those that share the wrist, cannot be judged by crossing; a thumb may lie on the
        # palm.
        if pieces[i][2] != pieces[j][2]
        and pieces[i][0] != pieces[j][0]
        and not (_THUMB in (pieces[i][2], pieces[j][2]) and 0 in (pieces[i][0], pieces[j][0]))
    )
    return _Lines(chains, pieces, beside, protocol.rows(("MCP2", "MCP3", "MCP4", "MCP5")))


@dataclass(frozen=True, slots=True)
class Misnamed:
    """Names that stand in for each other (``swapped``, two of equal length), or one that fits nowhere (``alone``)."""

    swapped: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    alone: str = ""


def misnamed(protocol: MarkerProtocol, side: Side, plan: FloatArray, settings: FingerOrderSettings) -> Misnamed | None:
    """What is wrong with the names of a ``plan`` (M, 2) seen from the camera, y up; None when nothing is."""
    lines = _lines_of(protocol)
    now = _faults(lines, side, plan, settings)
    if now < settings.clearly:
        return None
    best = np.inf
    rows: tuple[tuple[int, ...], tuple[int, ...]] = ((0,), (0,))
    for one, other in _exchanges(lines, len(plan)):
        trial = plan.copy()
        trial[[*one, *other]] = plan[[*other, *one]]
        value = _faults(lines, side, trial, settings)
        if value < best - 1e-9:
            best, rows = value, (one, other)
    names = protocol.markers
    exchanged = Misnamed((tuple(names[i] for i in rows[0]), tuple(names[i] for i in rows[1])))
    if best < settings.clearly:
        return exchanged
    # No exchange mends it all: is it one disc that lies outside of the hand?
    alone, without = _worst(lines, side, plan, settings)
    return Misnamed(alone=names[alone]) if without < settings.clearly or best >= now - settings.clearly else exchanged


def _exchanges(lines: _Lines, count: int) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Two discs, or two whole fingers."""
    fingers = [chain[1:] for digit, chain in lines.chains.items() if digit != _THUMB]
    single = [((i,), (j,)) for i, j in combinations(range(count), 2)]
    return [*single, *combinations(fingers, 2)]


def _worst(lines: _Lines, side: Side, plan: FloatArray, settings: FingerOrderSettings) -> tuple[int, float]:
    """The disc without which least is wrong, and how much: laid between its neighbours on the line, as if it fitted."""
    left = np.full(len(plan), np.inf)
    for chain in lines.chains.values():
        for place in range(1, len(chain)):
            trial = plan.copy()
            before = plan[chain[place - 1]]
            after = (
                plan[chain[place + 1]] if place + 1 < len(chain) else before + 0.5 * (before - plan[chain[place - 2]])
            )
            trial[chain[place]] = 0.5 * (before + after)
            left[chain[place]] = min(left[chain[place]], _faults(lines, side, trial, settings))
    return int(np.argmin(left)), float(left.min())


def _faults(lines: _Lines, side: Side, plan: FloatArray, settings: FingerOrderSettings) -> float:
    """Sum of all that speaks against the names, 0 for a usual hand."""
    size = float(np.median([np.hypot(*(plan[k] - plan[0])) for k in lines.knuckles]))
    if not size > 0.0:
        return 0.0
    faults = 0.0
    for digit, chain in lines.chains.items():
        steps = np.diff(plan[list(chain)], axis=0)
        length = np.hypot(steps[:, 0], steps[:, 1])
        most = np.array(settings.most_thumb_length if digit == _THUMB else settings.most_length)
        faults += float(np.maximum(length / size - most, 0.0).sum()) * settings.length_weight
        along = (steps[:-1] * steps[1:]).sum(axis=1)
        across = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
        turn_deg = np.degrees(np.abs(np.arctan2(across, along)))
        base_deg = settings.most_thumb_turn_deg if digit == _THUMB else settings.most_turn_deg
        limit_deg = np.array([base_deg] * 2 + [settings.most_turn_deg])
        # A very short piece, as of a finger bent towards the camera's line of sight, has no direction worth judging.
        weight = np.clip(np.minimum(length[:-1], length[1:]) / (settings.short * size), 0.0, 1.0)
        faults += float((weight * np.maximum(turn_deg - limit_deg, 0.0)).sum()) / settings.turn_deg
    faults += float(_crossings(lines, plan).sum())
    return faults + settings.order_weight * _knuckles_out_of_order(lines, side, plan)


def _crossings(lines: _Lines, plan: FloatArray) -> NDArray[np.bool_]:
    """Which pieces of different fingers cut each other, of the pairs ``beside``."""
    if not lines.beside:
        return np.zeros(0, dtype=bool)
    ends = np.array([(plan[a], plan[b]) for a, b, _ in lines.pieces])
    first, second = ends[[i for i, _ in lines.beside]], ends[[j for _, j in lines.beside]]

    def turn(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        return np.asarray((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))

    a, b, c, d = first[:, 0], first[:, 1], second[:, 0], second[:, 1]
    return np.asarray((turn(a, b, c) * turn(a, b, d) < 0.0) & (turn(c, d, a) * turn(c, d, b) < 0.0))


def _knuckles_out_of_order(lines: _Lines, side: Side, plan: FloatArray) -> int:
    """Neighbouring knuckles that follow each other the wrong way about the wrist."""
    ray = plan[list(lines.knuckles)] - plan[0]
    turn = ray[:-1, 0] * ray[1:, 1] - ray[:-1, 1] * ray[1:, 0]
    onwards = turn < 0.0 if side == "right" else turn > 0.0
    return int(np.count_nonzero(~onwards))
