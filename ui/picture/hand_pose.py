"""The drawn hand of the patient view: a forearm and a hand that take the pose of the measured angle.

Three views, each of a right hand in a plane of its own (x right, y down, the wrist or the middle of the hand at the
origin, the hand :data:`LENGTH` long): from the side with the fingers to the right and the palm below; from above with
the fingers up and the thumb at the left; and along the forearm, as one sees it oneself, with the thumb at the left.
A left hand is the mirror image.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import pairwise

from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainterPath, QPolygonF, QTransform

from carpus.core.model.hand.exercises import DEVIATION, FLEXION, PRONOSUPINATION, Exercise

LENGTH = 340.0
FOREARM = 1400.0
"""Long enough that its end is never visible."""


@dataclass(frozen=True, slots=True)
class Arc:
    """Path of one angle around a joint.

    Attributes
    ----------
    pivot : QPointF
        In the plane of the figure, as ``radius``.
    zero_deg : float
        Direction of 0 on the screen, clockwise from the right.
    sense : float
        Sign of a growing angle on the screen.
    """

    pivot: QPointF
    radius: float
    zero_deg: float
    sense: float
    gain: float = 1.0
    """Above 1, small angles are drawn larger than they are, to be visible from afar."""

    def point(self, value_deg: float) -> QPointF:
        turned = math.radians(self.zero_deg + self.sense * self.gain * value_deg)
        return self.pivot + QPointF(math.cos(turned), math.sin(turned)) * self.radius

    def path(self, from_deg: float, to_deg: float) -> QPainterPath:
        box = QRectF(self.pivot.x() - self.radius, self.pivot.y() - self.radius, 2 * self.radius, 2 * self.radius)
        path = QPainterPath()
        start = -(self.zero_deg + self.sense * self.gain * from_deg)
        path.arcMoveTo(box, start)
        path.arcTo(box, start, -self.sense * self.gain * (to_deg - from_deg))
        return path


@dataclass(frozen=True, slots=True)
class DrawnPose:
    """A drawn pose: a fixed ``arm``, a moving ``hand``, both in one outline, and the markers as ``dots``."""

    arm: QPainterPath
    hand: QPainterPath
    hand_and_arm: QPainterPath
    dots: tuple[QPointF, ...]
    dot_radius: float
    digits: tuple[QPainterPath, ...] = ()
    """What lies over the hand, to be drawn after it: a bent finger and the thumb, open where they grow out of it."""


def build_pose(exercise: Exercise, value_deg: float) -> DrawnPose:
    """Return the hand with its trained angle at a value, to half a degree."""
    return _build_pose(exercise, round(2.0 * value_deg) / 2.0)


@lru_cache(maxsize=512)
def _build_pose(exercise: Exercise, value_deg: float) -> DrawnPose:
    if exercise.angle == FLEXION:
        return draw_side_view(wrist_deg=value_deg)
    if exercise.angle == DEVIATION:
        return draw_top_view(deviation_deg=value_deg)
    if exercise.angle == PRONOSUPINATION:
        return draw_forearm_view(value_deg)
    if exercise.joint.startswith("MCP") and exercise.joint.endswith("flexion"):
        return draw_side_view(
            knuckle_deg=value_deg, middle_deg=1.1 * value_deg, end_deg=0.7 * value_deg,
            thumb_deg=_THUMB_AWAY_DEG - 0.4 * min(max(value_deg, 0.0), 90.0),
        )  # fmt: skip
    if exercise.joint.startswith("PIP"):
        return draw_side_view(middle_deg=value_deg, end_deg=0.66 * value_deg, thumb_deg=_THUMB_AWAY_DEG)
    if exercise.joint.startswith("CMC1"):
        return draw_side_view(thumb_deg=value_deg)
    return draw_top_view(spread_deg=value_deg)


def build_free_pose(exercise: Exercise, wrist_deg: tuple[float, float, float], bent_deg: float) -> DrawnPose:
    """Return the hand of an exercise without a trained angle."""
    deviation, flexion, _ = wrist_deg
    if not exercise.digits:
        return draw_top_view(deviation_deg=deviation, lifted_deg=flexion)
    bent = bent_deg if math.isfinite(bent_deg) else 0.0
    return draw_side_view(wrist_deg=flexion, knuckle_deg=0.8 * bent, middle_deg=bent, end_deg=0.6 * bent)


def find_arc(exercise: Exercise) -> Arc:
    """Return the path of the trained angle."""
    if exercise.angle == FLEXION:
        return Arc(QPointF(0, 0), 1.2 * LENGTH, 0.0, 1.0)
    if exercise.angle == DEVIATION:
        return Arc(QPointF(0, 0), 1.24 * LENGTH, -90.0, -1.0)
    if exercise.angle == PRONOSUPINATION:
        return Arc(QPointF(0, 0), 1.05 * LENGTH, 180.0, 1.0)
    if exercise.joint.startswith("MCP") and exercise.joint.endswith("flexion"):
        return Arc(_KNUCKLE, 0.75 * LENGTH, 0.0, 1.0)
    if exercise.joint.startswith("PIP"):
        return Arc(_KNUCKLE + QPointF(_FINGER[0][0], 0), 0.52 * LENGTH, 0.0, 1.0)
    if exercise.joint.startswith("CMC1"):
        return Arc(_THUMB_BASE, 0.66 * LENGTH, _THUMB_REST_DEG, 1.0)
    return Arc(_KNUCKLES[2], 0.66 * LENGTH, -80.0, -1.0, gain=2.5)


# --- from the side ----------------------------------------------------------------------------------------
_KNUCKLE = QPointF(0.45 * LENGTH, -4.0)
_FINGER = ((0.26 * LENGTH, 30.0, 26.0), (0.17 * LENGTH, 26.0, 23.0), (0.12 * LENGTH, 23.0, 19.0))
"""Length, and half widths at both ends, of the three phalanges."""
_THUMB_BASE = QPointF(0.14 * LENGTH, 20.0)
_THUMB_REST_DEG = 14.0
_THUMB_AWAY_DEG = 40.0
"""Position of the thumb clear of the closing fingers."""


def draw_side_view(
    *, wrist_deg: float = 0.0, knuckle_deg: float = 0.0, middle_deg: float = 0.0, end_deg: float = 0.0,
    thumb_deg: float = 22.0,
) -> DrawnPose:  # fmt: skip
    """Draw the hand from the side, palm down: flexion points down, the thumb moves away from the palm."""
    hand = _draw_capsule(QPointF(0, 0), 46.0, _KNUCKLE, 36.0)
    at, turned, joints = _KNUCKLE, 0.0, []
    for (length, first, last), bent in zip(_FINGER, (knuckle_deg, middle_deg, end_deg), strict=True):
        turned += math.radians(bent)
        then = at + QPointF(math.cos(turned), math.sin(turned)) * length
        hand = hand.united(_draw_capsule(at, first, then, last))
        joints.append((then, last))
        at = then
    finger = _draw_digit(joints)
    turned = math.radians(_THUMB_REST_DEG + thumb_deg)
    along = QPointF(math.cos(turned), math.sin(turned))
    middle = _THUMB_BASE + along * (0.19 * LENGTH)
    hand = hand.united(_draw_capsule(_THUMB_BASE, 30.0, middle, 24.0))
    tip = middle + along * (0.16 * LENGTH)
    hand = hand.united(_draw_capsule(middle, 24.0, tip, 18.0))
    thumb = _draw_digit([(_THUMB_BASE + along * 30.0, 29.0), (middle, 24.0), (tip, 18.0)])
    hand = _without_holes(hand)
    to = QTransform().rotate(wrist_deg)
    dots = (to.map(QPointF(4, -36)), to.map(_KNUCKLE + QPointF(0, -28)))
    return replace(_make_pose(_draw_arm(False), to.map(hand), dots, 9.0), digits=(to.map(finger), to.map(thumb)))


# --- from above -------------------------------------------------------------------------------------------
_KNUCKLES = {2: QPointF(-56, -158), 3: QPointF(-17, -170), 4: QPointF(22, -163), 5: QPointF(57, -146)}
_FINGERS = {2: 0.40 * LENGTH, 3: 0.45 * LENGTH, 4: 0.41 * LENGTH, 5: 0.32 * LENGTH}
_LEAN_DEG = {2: 4.0, 3: 1.0, 4: -3.0, 5: -8.0}
"""Lean of the straight, closed fingers towards the thumb."""
_SPREADS = {2: 1.0, 3: 0.0, 4: -0.8, 5: -1.5}


def draw_top_view(*, deviation_deg: float = 0.0, spread_deg: float = 0.0, lifted_deg: float = 0.0) -> DrawnPose:
    """Draw the hand from above, fingers up, thumb at the left; ``lifted_deg`` shortens it."""
    hand = QPainterPath()
    for finger, knuckle in _KNUCKLES.items():
        hand = hand.united(_draw_capsule(QPointF(0.35 * knuckle.x(), -10), 44.0, knuckle, 25.0))
        turned = math.radians(_LEAN_DEG[finger] + _SPREADS[finger] * spread_deg)
        tip = knuckle + QPointF(-math.sin(turned), -math.cos(turned)) * _FINGERS[finger]
        hand = hand.united(_draw_capsule(knuckle, 23.0, tip, 17.0))
    hand = hand.united(_draw_capsule(QPointF(-26, -40), 34.0, QPointF(-98, -104), 24.0))
    hand = hand.united(_draw_capsule(QPointF(-98, -104), 24.0, QPointF(-136, -176), 19.0))
    to = QTransform().rotate(-deviation_deg).scale(1.0, math.cos(math.radians(min(abs(lifted_deg), 85.0))))
    places = (QPointF(0, -12), QPointF(-44, -52), *_KNUCKLES.values())
    return _make_pose(_draw_arm(True), to.map(hand), tuple(to.map(place) for place in places))


# --- along the forearm ------------------------------------------------------------------------------------
def draw_forearm_view(supination_deg: float) -> DrawnPose:
    """Draw the hand along the forearm, palm down: supination lifts the thumb."""
    hand = _draw_capsule(QPointF(-120, 6), 58.0, QPointF(120, 12), 50.0)
    for x, y, half in ((-128, -24, 44.0), (-46, -38, 46.0), (38, -34, 45.0), (116, -18, 40.0)):
        knuckle = QPainterPath()
        knuckle.addEllipse(QPointF(x, y), half, half)
        hand = hand.united(knuckle)
    hand = hand.united(_draw_capsule(QPointF(-150, 40), 40.0, QPointF(-226, 22), 30.0))
    hand = hand.united(_draw_capsule(QPointF(-226, 22), 30.0, QPointF(-272, -4), 24.0))
    to = QTransform().rotate(supination_deg)
    dots = tuple(to.map(QPointF(x, y)) for x, y in ((-128, -40), (-46, -56), (38, -52), (116, -34)))
    return _make_pose(QPainterPath(), to.map(hand), dots)


def _make_pose(arm: QPainterPath, hand: QPainterPath, dots: tuple[QPointF, ...], dot_radius: float = 11.0) -> DrawnPose:
    return DrawnPose(arm, hand, arm.united(hand), dots, dot_radius)


def _draw_digit(joints: Sequence[tuple[QPointF, float]]) -> QPainterPath:
    """Draw the outline of a digit from its first joint round the tip to the joint before it; joints with radii."""
    path, corners, normal = QPainterPath(), list[QPointF](), QPointF()
    for (start, first), (end, last) in pairwise(joints):
        normal = QPointF(start.y() - end.y(), end.x() - start.x())
        normal /= math.hypot(normal.x(), normal.y())
        corners += [start + normal * first, end + normal * last]
    if len(corners) == 4:  # both phalanges meet at the inner side of the joint between them
        ends = QLineF(*corners[:2]).intersects(QLineF(*corners[2:]))
        corners[1:3] = [ends[1]] if ends[0] != QLineF.IntersectionType.NoIntersection else corners[1:3]
    path.addPolygon(QPolygonF(corners))
    (before, width), (tip, radius) = joints[-2:]
    start_deg = QLineF(tip, corners[-1]).angle()
    path.arcTo(QRectF(tip.x() - radius, tip.y() - radius, 2 * radius, 2 * radius), start_deg, 180.0)
    path.lineTo(before - normal * width)
    return path


def _without_holes(path: QPainterPath) -> QPainterPath:
    """Fill what a bent finger encloses."""
    rings = path.toSubpathPolygons(QTransform())
    if len(rings) < 2:
        return path
    outer = QPainterPath()
    outer.addPolygon(max(rings, key=lambda ring: ring.boundingRect().width() * ring.boundingRect().height()))
    outer.closeSubpath()
    return outer


@cache
def _draw_arm(upright: bool) -> QPainterPath:
    end = QPointF(0, FOREARM) if upright else QPointF(-FOREARM, 0)
    return _draw_capsule(QPointF(0, 0), 44.0, end, 100.0)


def _draw_capsule(first: QPointF, first_half: float, last: QPointF, last_half: float) -> QPainterPath:
    """Draw two circles and the area between them."""
    path = QPainterPath()
    path.addEllipse(first, first_half, first_half)
    second = QPainterPath()
    second.addEllipse(last, last_half, last_half)
    across = last - first
    length = math.hypot(across.x(), across.y())
    if length <= abs(first_half - last_half):
        return path if first_half >= last_half else second
    # Where the two common tangents touch: seen from the line between the middles by this much before its normal.
    lean = math.acos((first_half - last_half) / length)
    base = math.atan2(across.y(), across.x())
    sides = [QPointF(math.cos(base + turn), math.sin(base + turn)) for turn in (lean, -lean)]
    between = QPainterPath()
    corners = [first + sides[0] * first_half, last + sides[0] * last_half]
    corners += [last + sides[1] * last_half, first + sides[1] * first_half]
    between.addPolygon(QPolygonF(corners))
    between.closeSubpath()
    return path.united(between).united(second)
