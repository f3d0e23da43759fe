"""Placement of a marker's label so that it cannot be taken for that of another marker."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF


def place_label(
    size: QSizeF,
    center: QPointF,
    radius_px: float,
    taken: Sequence[QRectF],
    others: Sequence[QPointF],
    inside: QRectF,
    lines: Sequence[QLineF] = (),
) -> tuple[QRectF, QLineF | None] | None:
    """Find a place for a label of ``size`` next to the ring of ``radius_px`` around ``center``.

    The label avoids all that is ``taken`` and all ``lines``. Next to the ring no other ring may be nearer; farther
    away it gets a line that crosses no ring, label or line. Returns box and line, or None if there is no room.
    """
    for away in (
        radius_px + 5,
        radius_px + 24,
        radius_px + 44,
        radius_px + 70,
        radius_px + 100,
        radius_px + 140,
        radius_px + 190,
    ):
        far = away > radius_px + 5
        for plate in _candidate_boxes(center, size, away, radius_px + 1 if not far else away):
            if not inside.contains(plate) or any(plate.intersects(other) for other in taken):
                continue
            if any(_is_crossed(plate, line) for line in lines):
                continue
            end = _closest_point(plate, center)
            own = QLineF(end, center).length()
            if not far:
                if any(QLineF(_closest_point(plate, other), other).length() <= own for other in others):
                    continue
                return plate, None
            if any(QLineF(_project_point(center, end, other), other).length() <= radius_px for other in others):
                continue
            line = QLineF(center + (end - center) * (radius_px / own), end)
            if any(_are_crossing(line, other) for other in lines) or any(
                _is_crossed(other, line) for other in taken if not other.contains(center)
            ):
                continue
            return plate, line
    return None


def _candidate_boxes(center: QPointF, size: QSizeF, distance: float, slant: float) -> list[QRectF]:
    """Return the eight boxes around a point, the best first; ``slant`` is the offset of the corner ones."""
    width, height = size.width(), size.height()
    corners = (
        (distance, -height / 2),
        (-distance - width, -height / 2),
        (-width / 2, -distance - height),
        (-width / 2, distance),
        (slant, -slant - height),
        (-slant - width, -slant - height),
        (slant, slant),
        (-slant - width, slant),
    )
    return [QRectF(center + QPointF(x, y), size) for x, y in corners]


def _are_crossing(one: QLineF, other: QLineF) -> bool:
    return one.intersects(other)[0] == QLineF.IntersectionType.BoundedIntersection


def _is_crossed(box: QRectF, line: QLineF) -> bool:
    """Return whether a line passes through a box, not only along its edge."""
    inner = box.adjusted(1, 1, -1, -1)
    corners = (inner.topLeft(), inner.topRight(), inner.bottomRight(), inner.bottomLeft())
    edges = [QLineF(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]
    return inner.contains(line.p1()) or inner.contains(line.p2()) or any(_are_crossing(line, edge) for edge in edges)


def _closest_point(plate: QRectF, point: QPointF) -> QPointF:
    return QPointF(min(max(point.x(), plate.left()), plate.right()), min(max(point.y(), plate.top()), plate.bottom()))


def _project_point(begin: QPointF, end: QPointF, point: QPointF) -> QPointF:
    """Return the point of a line that is nearest to ``point``."""
    way = end - begin
    length = QPointF.dotProduct(way, way)
    part = min(max(QPointF.dotProduct(point - begin, way) / length, 0.0), 1.0) if length else 0.0
    return begin + way * part
