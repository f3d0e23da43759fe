"""What a comparison says: the sentence, its sign words, the judgement, the places of the plot."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QRectF

from carpus.core.agreement.compare import Compared, Pairs
from carpus.core.agreement.statistics import agreement, judged
from carpus.ui.agreement.reference_sheet import missing
from carpus.ui.agreement.screen import AgreementScreen
from carpus.ui.controls.text import Text
from carpus.ui.keys import Keys
from carpus.ui.plot.agreement import AgreementPlot
from carpus.ui.plot.style import screen_style
from carpus.ui.ports import Preferences
from carpus.ui.settings.screen import SettingsScreen
from carpus.ui.theme import Theme
from carpus.ui.words.agreement import angle_name, headline, in_order, interval, judgement_words, limits, signed
from tests.ui.conftest import Show
from tests.ui.fakes import compared


def of(name: str, bias: float, sd: float, count: int = 200) -> Pairs:
    """Readings about ``bias``, the same each time."""
    draw = np.random.default_rng(7)
    reference = np.linspace(-40.0, 40.0, count)
    noise = draw.standard_normal(count)
    measured = reference + bias + sd * (noise - noise.mean()) / noise.std(ddof=1)
    figures = agreement(measured, reference, waveform=False)
    return Pairs(name, np.arange(count) / 30.0, np.radians(measured), np.radians(reference), figures)


def all_of(*pairs: Pairs) -> Compared:
    return replace(compared(readings=True), pairs=pairs, not_used=())


def test_the_sign_is_a_word() -> None:
    assert signed(-3.44, "flexion") == "3.4° extension"
    assert signed(0.31, "deviation") == "0.3° radial"
    assert signed(-2.0, "PIP3_flexion") == "2.0° less"
    assert interval((0.2, 1.2), "flexion") == "0.2° to 1.2°"
    assert interval((-3.4, -2.6), "flexion") == "2.6° to 3.4°"
    assert interval((-0.8, 2.4), "deviation") == "0.8° ulnar to 2.4° radial"
    assert signed(float("nan"), "flexion") == "–"
    assert limits(of("flexion", -2.0, 0.5).figures_deg, "flexion") == "1.0° to 3.0° extension"
    assert limits(of("flexion", 1.0, 1.0).figures_deg, "flexion") == "1.0° extension to 3.0° flexion"
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
def test_both_limits_must_lie_within_what_was_set_and_few_or_scattered_readings_say_nothing(
    bias: float, sd: float, count: int, limit: float, verdict: str
) -> None:
    assert judged(of("flexion", bias, sd, count).figures_deg, limit) == verdict


def test_the_sentence_names_what_agrees_and_what_does_not() -> None:
    good, bad, few = of("flexion", 0.0, 1.0), of("pronosupination", 1.0, 4.0), of("deviation", 0.0, 1.0, 8)
    assert headline(all_of(good), 5.0)[0] == "Flexion–extension agrees within 5°."
    assert headline(all_of(good, bad), 5.0)[0] == "Flexion–extension agrees within 5°. Turning does not."
    assert headline(all_of(bad), 5.0)[0] == "Turning does not agree within 5°."
    assert headline(all_of(good, few), 5.0)[0].endswith("Too few readings of side movement.")
    sentence, basis = headline(all_of(good), 0.0)
    assert sentence.endswith("Not judged.")
    assert "Settings" in basis
    assert judgement_words(bad, 5.0, readings=False) == ("bad", "up to 9° apart: do not mix")
    assert in_order(all_of(bad, few, good)).pairs[0].name == "flexion"


def test_what_lies_within_the_plot_is_where_its_axis_says(theme: Theme) -> None:
    pairs = of("flexion", 2.0, 1.0)
    plot = AgreementPlot(pairs, 5.0, over_time=False)
    panel = plot.panel(screen_style(theme), QRectF(0, 0, 900, 300))
    shown = pairs.figures_deg.limits
    assert float(panel.y(shown[1])) < float(panel.y(shown[0])), "more flexion is above"
    assert panel.scale.low < shown[0]
    assert shown[1] < panel.scale.high
    start, end = plot.extent()
    assert start < np.degrees(pairs.measured_rad).min()
    assert end > np.degrees(pairs.reference_rad).max()
    words = [text for _, text in plot.along_labels(start, end)]
    assert words[0].startswith("extension")
    assert words[-1].startswith("flexion")
    assert not any("-" in text for text in words)


def test_the_screen_shows_one_angle_and_both_views(theme: Theme, show: Show[AgreementScreen]) -> None:
    screen = show(AgreementScreen(theme, Keys()))
    assert not screen.save_button.isEnabled()
    found = compared()
    screen.show_compared(found, "optical.c3d", 5.0, may_map=True)
    assert screen.angle.currentData() == "flexion"
    assert screen.chart.plot.view == "differences"
    screen.next_view()
    assert screen.chart.plot.view == "curves"
    screen.angle.setCurrentIndex(screen.angle.findData("pronosupination"))
    assert screen.chart.plot.pairs.name == "pronosupination"
    said = " ".join(text.text() for text in screen.findChildren(Text))
    for piece in ("34", "100 a second", "214 of 1860", "ELBOW", "agree within 5°", "do not mix", "Carpus later"):
        assert piece in said
    screen.running("another.mot")
    assert screen.compared is None
    assert not screen.save_button.isEnabled()


PALM = {"WRIST": "a", "MCP2": "b", "MCP5": "c"}


@pytest.mark.parametrize(
    ("kind", "named", "said"),
    [
        ("points", PALM, ""), ("points", {"WRIST": "a", "MCP2": "b", "TIP2": "d"}, "discs"),
        ("angles", {"flexion": "x"}, "time"), ("angles", {"time": "t"}, "angle"),
        ("angles", {"time": "t", "flexion": "x"}, ""),
    ],
)  # fmt: skip
def test_what_must_be_said_before_comparing(kind: str, named: dict[str, str], said: str) -> None:
    assert missing(SimpleNamespace(kind=kind), named) == said


def test_the_limit_is_set_in_the_settings(theme: Theme, show: Show[SettingsScreen]) -> None:
    screen = show(SettingsScreen(theme, Preferences()))
    told: list[Preferences] = []
    screen.changed.connect(told.append)
    for text in ("5", "200", ""):
        screen.agreement.setText(text)
        screen.agreement.editingFinished.emit()
    assert [one.agreement_limit_deg for one in told] == [5.0, 0.0], "what cannot be is not taken"
