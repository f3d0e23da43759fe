"""How a number that a person reads is rounded: halves away from zero, as everybody learnt it; Python rounds to even."""

from __future__ import annotations

import math
from decimal import ROUND_HALF_UP, Decimal


def round_half_away(value: float) -> int:
    """The nearest whole number, halves away from zero.

    >>> rounded(44.5), rounded(-44.5), rounded(0.4999)
    (45, -45, 0)
    """
    return int(Decimal(repr(float(value))).quantize(Decimal(1), ROUND_HALF_UP))


def format_rounded(value: float, decimals: int = 0) -> str:
    """A number with that many decimals, halves away from zero; nothing is never minus nothing.

    >>> written(44.5), written(-44.5), written(0.25, 1), written(-0.04, 1), written(math.nan)
    ('45', '-45', '0.3', '0.0', 'nan')
    """
    if not math.isfinite(value):
        return f"{value}"
    shown = Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP)
    return f"{abs(shown) if shown == 0 else shown:f}"
