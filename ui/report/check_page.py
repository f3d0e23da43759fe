"""The one-page result of a camera check: the sentence, the six figures, and both control charts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.calibration.card.card import FIGURES
from carpus.core.calibration.card.chart import USUAL_OF, CardCheck, Verdict, sentence_of, verdict_of
from carpus.ui import numbers
from carpus.ui.fonts import MEDIUM, SEMIBOLD
from carpus.ui.plot.control_chart import ControlMarks, ControlPlot, control_plots, paint_control_ground
from carpus.ui.plot.marks import Scales
from carpus.ui.report.page import Page, PageColumn
from carpus.ui.report.pdf import write_page
from carpus.ui.translate import say, tr
from carpus.ui.words.check_card import figure_name

TITLE = "Carpus camera check"
_ROW_PT, _CHART_PT = 20.0, 140.0
TABLE = (
    PageColumn(0.0, size_pt=10.0), PageColumn(0.49, ends=True, size_pt=10.0),
    PageColumn(0.725, ends=True, size_pt=10.0), PageColumn(1.0, SEMIBOLD, ends=True, size_pt=10.0),
)  # fmt: skip
_TOKENS: dict[Verdict, str] = {"right": "good", "unusual": "warn", "out": "bad"}


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The newest ``check`` of a camera, those before it, and what is said of the picture-taking (``asides``)."""

    camera: str
    check: CardCheck
    earlier: Sequence[CardCheck]
    asides: Sequence[tuple[str, str]]


def write_check_report(path: Path, result: CheckResult) -> Path:
    """Write the page. Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`."""
    return write_page(path, lambda page: paint_check_page(page, result), TITLE)


def paint_check_page(page: Page, result: CheckResult) -> None:
    """Paint the page."""
    check, earlier = result.check, result.earlier
    verdict = verdict_of(earlier, check)
    page.text(tr("Carpus camera check"), page.left, 62, 15, SEMIBOLD)
    page.text_right(numbers.report_date(datetime.fromisoformat(check.when)), page.right, 62, 10, MEDIUM)
    lower = page.said(say(sentence_of(check, verdict)), 76, 12, SEMIBOLD, _TOKENS[verdict])
    pairs = [(tr("Camera"), result.camera), *result.asides]
    page.facts(pairs, lower + 10, (0.0, *(0.46 + 0.54 * k / (len(pairs) - 1) for k in range(len(pairs) - 1))))
    top = _table(page, check, lower + 60)
    for plot in control_plots([*earlier, check]):
        top = _chart(page, top + 28, plot)
    said = tr(
        "Limits are fixed, wider only for a sensor that cannot do better. Usual: mean of the first {count} checks "
        "after a calibration, ± 3 sd. ± in the table is the sd of one picture. All lengths off by one share: the "
        "depth, or a card that was not printed at 100 % (its ruler says which). If it is out: check once more, then "
        "calibrate; still out: do not measure with it."
    )
    page.said(said.format(count=USUAL_OF), top + 22, 8.5, token="text2")


def _table(page: Page, check: CardCheck, top: float) -> float:
    """The six figures; returns the lower edge."""
    rows = []
    for figure, measured, sd in zip(FIGURES, check.measured, check.sd, strict=True):
        unit = "°" if figure.kind == "angle" else " mm"
        off = f"{numbers.signed(measured - figure.true, 1)}{unit}"
        seen = f"{numbers.fixed(measured, 1)} ± {numbers.fixed(sd, 1)}{unit}"
        rows.append((figure_name(figure.name), f"{numbers.fixed(figure.true, 1)}{unit}", seen, off))
    rows.append((tr("All distances together"), "", "", f"{numbers.signed(100.0 * (check.scale - 1.0), 2)} %"))
    heads = (tr("On the card"), tr("True"), tr("Measured"), tr("Off by"))
    return page.table(TABLE, rows, top - 8, heads=heads, pitch_pt=_ROW_PT, drop_pt=6.0) - 6


def _chart(page: Page, top: float, plot: ControlPlot) -> float:
    """One control chart over the last checks, as on the screen; returns the lower edge."""
    page.title(plot.title, top)
    panel = plot.panel(page.box(page.left + 26, top + 12, page.right - page.left - 116, _CHART_PT))
    Scales().paint(page.painter, page.style, panel)
    paint_control_ground(page.painter, page.style, plot, panel)
    ControlMarks(plot).paint(page.painter, page.style, panel)
    return top + 24 + _CHART_PT
