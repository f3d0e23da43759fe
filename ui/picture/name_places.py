"""Where a name stands beside its disc, so that nobody takes it for the name of another disc."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF


def place_for(
    size: QSizeF,
    at: QPointF,
    radius: float,
    taken: Sequence[QRectF],
    others: Sequence[QPointF],
    inside: QRectF,
    lines: Sequence[QLineF] = (),
) -> tuple[QRectF, QLineF | None] | None:
    """A plate of ``size`` for the ring of ``radius`` px around ``at``, clear of all that is ``taken`` and of ``lines``.

    Beside the ring where no other ring is nearer to it; else further off, with a line to it that crosses no other
    ring, no plate and no other line. None where there is no room.
    """
    for away in (radius + 5, radius + 24, radius + 44, radius + 70, radius + 100, radius + 140, radius + 190):
        far = away > radius + 5
        for plate in _plates(at, size, away, radius + 1 if not far else away):
            if not inside.contains(plate) or any(plate.intersects(other) for other in taken):
                continue
            if any(_meets(plate, line) for line in lines):
                continue
            end = _nearest(plate, at)
            own = _apart(end, at)
            if not far:
                if any(_apart(_nearest(plate, other), other) <= own for other in others):
                    continue
                return plate, None
            if any(_apart(_on_line(at, end, other), other) <= radius for other in others):
                continue
            line = QLineF(at + (end - at) * (radius / own), end)
            if any(_cross(line, other) for other in lines) or any(
                _meets(other, line) for other in taken if not other.contains(at)
            ):
                continue
            return plate, line
    return None


def _plates(at: QPointF, size: QSizeF, away: float, slant: float) -> list[QRectF]:
    """The eight places around a point, the best first; ``slant`` how far off those at the corners are."""
    width, height = size.width(), size.height()
    corners = (
        (away, -height / 2), (-away - width, -height / 2), (-width / 2, -away - height), (-width / 2, away),
        (slant, -slant - height), (-slant - width, -slant - height), (slant, slant), (-slant - width, slant),
    )  # fmt: skip
    return [QRectF(at + QPointF(x, y), size) for x, y in corners]


def _cross(one: QLineF, other: QLineF) -> bool:
    return one.intersects(other)[0] == QLineF.IntersectionType.BoundedIntersection


def _meets(box: QRectF, line: QLineF) -> bool:
    """Whether a line runs through a box, beyond touching its edge."""
    inner = box.adjusted(1, 1, -1, -1)
    corners = (inner.topLeft(), inner.topRight(), inner.bottomRight(), inner.bottomLeft())
    edges = [QLineF(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]
    return inner.contains(line.p1()) or inner.contains(line.p2()) or any(_cross(line, edge) for edge in edges)


def _apart(a: QPointF, b: QPointF) -> float:
    return math.hypot(a.x() - b.x(), a.y() - b.y())


def _nearest(plate: QRectF, point: QPointF) -> QPointF:
    return QPointF(min(max(point.x(), plate.left()), plate.right()), min(max(point.y(), plate.top()), plate.bottom()))


def _on_line(begin: QPointF, end: QPointF, point: QPointF) -> QPointF:
    """The place of a line that is nearest to a point."""
    way = end - begin
    length = QPointF.dotProduct(way, way)
    part = min(max(QPointF.dotProduct(point - begin, way) / length, 0.0), 1.0) if length else 0.0
    return begin + way * part
