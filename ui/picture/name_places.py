"""Where a name stands beside its disc, so that nobody takes it for the name of another disc."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF


def place_for(
    size: QSizeF, at: QPointF, radius: float, taken: Sequence[QRectF], others: Sequence[QPointF], inside: QRectF
) -> tuple[QRectF, QLineF | None] | None:
    """A plate of ``size`` for the ring of ``radius`` px around ``at``, clear of all that is ``taken``.

    Beside the ring where no other ring is nearer to it; else further off, with a line to it that crosses no other
    ring. None where there is no room.
    """
    for away in (radius + 5, radius + 24, radius + 44, radius + 70):
        far = away > radius + 5
        for plate in _plates(at, size, away, radius + 1 if not far else away):
            if not inside.contains(plate) or any(plate.intersects(other) for other in taken):
                continue
            end = _nearest(plate, at)
            own = _apart(end, at)
            if not far:
                if any(_apart(_nearest(plate, other), other) <= own for other in others):
                    continue
                return plate, None
            if any(_apart(_on_line(at, end, other), other) <= radius for other in others):
                continue
            return plate, QLineF(at + (end - at) * (radius / own), end)
    return None


def _plates(at: QPointF, size: QSizeF, away: float, slant: float) -> list[QRectF]:
    """The eight places around a point, the best first; ``slant`` how far off those at the corners are."""
    width, height = size.width(), size.height()
    corners = (
        (away, -height / 2), (-away - width, -height / 2), (-width / 2, -away - height), (-width / 2, away),
        (slant, -slant - height), (-slant - width, -slant - height), (slant, slant), (-slant - width, slant),
    )  # fmt: skip
    return [QRectF(at + QPointF(x, y), size) for x, y in corners]


def _apart(a: QPointF, b: QPointF) -> float:
    return math.hypot(a.x() - b.x(), a.y() - b.y())


def _nearest(plate: QRectF, point: QPointF) -> QPointF:
    """The place of a plate that is nearest to a point."""
    return QPointF(min(max(point.x(), plate.left()), plate.right()), min(max(point.y(), plate.top()), plate.bottom()))


def _on_line(begin: QPointF, end: QPointF, point: QPointF) -> QPointF:
    """The place of a line that is nearest to a point."""
    way = end - begin
    length = QPointF.dotProduct(way, way)
    part = min(max(QPointF.dotProduct(point - begin, way) / length, 0.0), 1.0) if length else 0.0
    return begin + way * part
