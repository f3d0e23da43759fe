"""The three planes in which the papers draw ways through the room, and the hand's axes in them."""

from __future__ import annotations

UP = (0, 2, 2)
ACROSS = (1, 0, 1)
ACROSS_SIGN = (-1.0, 1.0, -1.0)
"""From above and from the fingers Y of W0 points to the left of the picture, on both hands."""
AXIS_TOKENS = ("curve_c", "curve_a", "curve_b")
"""X turns pro/supination, Y flexion, Z deviation: each axis has the colour of its angle."""
AXIS_LETTERS = ("X", "Y", "Z")
