"""A name is never taken for the name of another disc, however near the discs lie to each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, QSizeF

from carpus.ui.picture.label_placement import place_label

INSIDE = QRectF(4, 4, 632, 364)
RADIUS = 13.0


def off(plate: QRectF, at: QPointF) -> float:
    return math.hypot(
        max(plate.left() - at.x(), 0.0, at.x() - plate.right()), max(plate.top() - at.y(), 0.0, at.y() - plate.bottom())
    )


def test_place_label_is_nearest_to_its_ring_or_has_a_line() -> None:
    for seed in range(40):
        rng = np.random.default_rng(seed)
        middle = rng.uniform((150, 100), (490, 270))
        points = [QPointF(*map(float, middle + rng.uniform(-70, 70, 2))) for _ in range(6)]
        taken = [QRectF(at.x() - RADIUS, at.y() - RADIUS, 2 * RADIUS, 2 * RADIUS) for at in points]
        placed = 0
        for number, at in enumerate(points):
            others = [other for one, other in enumerate(points) if one != number]
            found = place_label(QSizeF(125.0, 26.0), at, RADIUS, taken, others, INSIDE)
            if found is None:
                continue
            plate, line = found
            assert INSIDE.contains(plate), seed
            assert not any(plate.intersects(other) for other in taken), seed
            if line is None:
                assert all(off(plate, at) < off(plate, other) for other in others), seed
            else:
                assert math.hypot(line.x1() - at.x(), line.y1() - at.y()) == pytest.approx(RADIUS)
                assert off(plate, line.p2()) == pytest.approx(0.0, abs=1e-6)
                along = [line.pointAt(float(part)) for part in np.linspace(0, 1, 50)]
                away = [math.hypot(at.x() - one.x(), at.y() - one.y()) for at in along for one in others]
                assert min(away) >= RADIUS - 0.1, seed
            taken.append(plate)
            placed += 1
        assert placed >= 3, seed
