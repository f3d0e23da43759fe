"""What a comparison says: its sign words, the judgement, the places of the plot."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.research.agreement.compare import AnglePairs
from carpus.core.research.agreement.statistics import compute_agreement, judge_agreement
from carpus.ui.words.agreement import angle_name, format_difference, format_interval


def of(name: str, bias: float, sd: float, count: int = 200) -> AnglePairs:
    """Readings about ``bias``, the same each time."""
    draw = np.random.default_rng(7)
    reference = np.linspace(-40.0, 40.0, count)
    noise = draw.standard_normal(count)
    measured = reference + bias + sd * (noise - noise.mean()) / noise.std(ddof=1)
    figures = compute_agreement(measured, reference, waveform=False)
    return AnglePairs(name, np.arange(count) / 30.0, np.radians(measured), np.radians(reference), figures)


def test_sign_is_word() -> None:
    assert format_difference(-3.44, "flexion") == "3.4° extension"
    assert format_difference(0.31, "deviation") == "0.3° radial"
    assert format_difference(-2.0, "PIP3_flexion") == "2.0° less"
    assert format_interval((0.2, 1.2), "flexion") == "0.2° to 1.2°"
    assert format_interval((-3.4, -2.6), "flexion") == "2.6° to 3.4°"
    assert format_interval((-0.8, 2.4), "deviation") == "0.8° ulnar to 2.4° radial"
    assert format_difference(float("nan"), "flexion") == "–"
    names = {angle_name(name) for name in ("MCP1_abduction", "PIP3_flexion", "MCP1_flexion", "DIP3_flexion")}
    assert len(names) == 4


@pytest.mark.parametrize(
    ("bias", "sd", "count", "limit", "verdict"),
    [
        (0.0, 2.0, 200, 5.0, "agree"), (0.0, 2.0, 200, 3.5, "apart"), (4.0, 1.0, 200, 5.0, "apart"),
        (-4.0, 1.0, 200, 5.0, "apart"), (0.0, 2.0, 200, 0.0, "not_judged"), (0.0, 0.5, 10, 5.0, "agree"),
        (0.0, 0.5, 9, 5.0, "few"), (0.0, 4.0, 11, 4.0, "few"),  # its limit is not known as well as that
    ],
)  # fmt: skip
def test_agreement_verdict_needs_both_limits_and_enough_readings(
    bias: float, sd: float, count: int, limit: float, verdict: str
) -> None:
    assert judge_agreement(of("flexion", bias, sd, count).figures_deg, limit) == verdict
