"""Whether two measurements may stand for each other, judged against a limit that was set before they were compared."""

from __future__ import annotations

import math
from typing import Literal

from carpus.core.agreement.statistics import FEWEST_TO_JUDGE, Agreement

Judgement = Literal["agree", "apart", "few", "not_judged"]


def judged(figures: Agreement, limit: float) -> Judgement:
    """``agree`` where both limits of agreement lie within ± ``limit``; ``not_judged`` where none was set (0). Too few
    to say: fewer pairs than :data:`FEWEST_TO_JUDGE`, or a limit known less well than the limit to be kept.

    >>> from carpus.core.agreement.statistics import agreement
    >>> import numpy as np
    >>> wave, off = np.sin(np.arange(40.0)) * 30.0, np.tile([-1.0, 1.0], 20)
    >>> [judged(agreement(wave + off, wave, waveform=False), limit) for limit in (0.0, 1.5, 5.0)]
    ['not_judged', 'apart', 'agree']
    >>> judged(agreement(wave[:9] + off[:9], wave[:9], waveform=False), 5.0)
    'few'
    """
    if not limit > 0.0:
        return "not_judged"
    if figures.count < FEWEST_TO_JUDGE:
        return "few"
    widths = [high - low for low, high in (figures.lower_interval, figures.upper_interval)]
    if not max(widths) <= limit:
        return "few"
    return "agree" if furthest(figures) <= limit else "apart"


def furthest(figures: Agreement) -> float:
    """The limit of agreement that is further from nothing, without its sign; NaN where there is none."""
    return max(map(abs, figures.limits)) if all(map(math.isfinite, figures.limits)) else math.nan
