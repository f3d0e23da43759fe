"""Rounding for people to read: halves away from zero (Python rounds to even)."""

from __future__ import annotations

import math
from decimal import ROUND_HALF_UP, Decimal


def round_half_away(value: float) -> int:
    """Round to the nearest whole number, halves away from zero.

    >>> round_half_away(44.5), round_half_away(-44.5), round_half_away(0.4999)
    (45, -45, 0)
    """
    return int(Decimal(repr(float(value))).quantize(Decimal(1), ROUND_HALF_UP))


def format_rounded(value: float, decimals: int = 0) -> str:
    """Format a number with so many decimals, halves away from zero, never "-0".

    >>> format_rounded(-44.5), format_rounded(0.25, 1), format_rounded(-0.04, 1), format_rounded(math.nan)
    ('-45', '0.3', '0.0', 'nan')
    """
    if not math.isfinite(value):
        return f"{value}"
    shown = Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP)
    return f"{abs(shown) if shown == 0 else shown:f}"
