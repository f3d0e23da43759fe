"""How far a session agrees with another measurement: sentence, plot, how the two were brought together, figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QGridLayout, QVBoxLayout, QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line, named_by_color
from carpus.ui.controls.field import Choices, Combo
from carpus.ui.controls.layouts import (
    STRETCH,
    Fitted,
    ScrollArea,
    ScrolledColumn,
    empty,
    fill,
    in_column,
    in_grid,
    in_line,
)
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Sign, Text, caption, heading
from carpus.ui.icons import State
from carpus.ui.keys import Keys, bind_screen
from carpus.ui.plot.agreement import AgreementPlot, View
from carpus.ui.plot.agreement_view import AgreementChart
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.translate import say
from carpus.ui.words.agreement import (
    angle_name,
    angle_token,
    headline,
    in_order,
    interval,
    joined_rows,
    judgement_words,
    left_words,
    limits,
    most_moved,
    remark_words,
    share,
    signed,
    tenths,
)

if TYPE_CHECKING:
    from carpus.core.agreement.compare import Compared, Pairs


class AgreementScreen(Fitted):
    """``other`` asks for another reference, ``columns`` for what in it is what; ``stop`` ends a comparison on the way;
    ``save`` asks for tables and plots; ``told`` a fault."""

    other = Signal()
    columns = Signal()
    stop = Signal()
    save = Signal()
    told = Signal(object)

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__()
        self._theme = theme
        self.compared: Compared | None = None
        self.limit_deg = 0.0
        """What it is judged against; 0 for none."""
        self.other_button = Button(theme, self.tr("Other &reference…"))
        self.columns_button = Button(theme, self.tr("&Columns…"))
        self.facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.save_button = Button(
            theme, self.tr("Save tables and plots…"), "primary", icon="download", hint="Ctrl+E", height_px=44
        )
        self.answer = heading(theme, wrap=True)
        self.basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.bar = ThinBar(theme, self.tr("How far the comparison is"))
        self.stop_button = Button(theme, self.tr("Stop"))
        self.angle = Combo()
        self.angle.setAccessibleName(self.tr("Angle"))
        self.view = Choices(theme, [("differences", self.tr("Differences")), ("curves", self.tr("Curves"))])
        self.chart = AgreementChart(theme)
        self.table = AgreementTable(theme)
        self._joined = Card(theme, 20)
        self._lay_out()
        self.other_button.clicked.connect(self.other)
        self.columns_button.clicked.connect(self.columns)
        self.save_button.clicked.connect(self.save)
        self.stop_button.clicked.connect(self.stop)
        self.angle.currentIndexChanged.connect(lambda _: self._show_plot())
        self.view.chosen.connect(lambda _: self._show_plot())
        self.chart.menu.told.connect(self.told)
        actions = {
            "export": self.save_button.click, "next_view": self.next_view, "plot_in": self.chart.zoom_in,
            "plot_out": self.chart.zoom_out, "plot_all": self.chart.show_all,
        }  # fmt: skip
        bind_screen(self, keys, actions)

    def _lay_out(self) -> None:
        head = in_line(self.other_button, self.columns_button, (self.facts, 1), self.save_button, gap=12)
        over = in_line(gap=12, margins=(20, 10, 56, 0))
        for widget in (self.angle, self.view):
            widget.setProperty("floats", True)  # in the head of the card, in which nothing is painted
        fill(over, self.angle, self.view, STRETCH)
        in_column(over, STRETCH, margins=(0, 0, 0, 0), within=self.chart)
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._columns.setSpacing(GAP_PX)
        fill(self._columns, (self.chart, 1), self._joined)
        figures = Card(self._theme, 20)
        figures.body.setContentsMargins(24, 12, 16, 12)
        title = in_line(Text(self._theme, self.tr("Per angle"), 16, SEMIBOLD), gap=12)
        words = self.tr("Carpus less the reference; in brackets 95 % intervals, repeated values allowed for")
        title.addWidget(caption(self._theme, words, wrap=True), 1)
        fill(figures.body, title, self.table)
        words = self.tr("The limit is a choice, not a proof: change it in Settings, before comparing.")
        figures.body.addWidget(caption(self._theme, words, wrap=True))
        host = ScrolledColumn()
        in_column((self._columns, 1), figures, gap=GAP_PX, margins=(0, 0, 0, 0), within=host)
        self._body = ScrollArea(host)
        self._work = Card(self._theme, 24)
        fill(self._work.body, Text(self._theme, self.tr("Bringing the two together…"), 16, SEMIBOLD), self.bar)
        self._work.body.addLayout(in_line(STRETCH, self.stop_button))
        whole = in_column(
            head,
            12,
            self.answer,
            2,
            self.basis,
            12,
            self._work,
            (self._body, 1),
            gap=0,
            margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX),
            within=self,
        )
        whole.addStretch(0)
        self._theme.changed.connect(self._fit)
        self.begin()

    def _fit(self) -> None:
        """With large text what stood at the right goes below."""
        tight = is_tight(self, self._theme)
        directions = QBoxLayout.Direction
        self._columns.setDirection(directions.TopToBottom if tight else directions.LeftToRight)
        self._joined.setMinimumWidth(0 if tight else self._theme.px(352))
        self._joined.setMaximumWidth(16_777_215 if tight else self._theme.px(352))
        self.save_button.set_face(self.save_button.text(), hint="" if tight else "Ctrl+E")

    # --- states -------------------------------------------------------------------------------------------
    def begin(self, *, may_map: bool = False) -> None:
        """Nothing is compared yet; ``may_map`` whether columns or markers of what was tried can be told."""
        self.compared = None
        self.facts.setText("")
        self.answer.setText(self.tr("Compare this session with another measurement."))
        words = self.tr("Of the same movement: markers, angles, goniometer readings, or another session.")
        self.basis.setText(words)
        self.other_button.set_face(self.tr("Choose a &reference…"))
        self._show_parts(working=False)
        self.columns_button.setVisible(may_map)

    def running(self, name: str) -> None:
        self.compared = None
        self.facts.setText(name)
        self.answer.setText(self.tr("Comparing with {name}…").format(name=name))
        self.basis.setText(self.tr("The session itself is never changed."))
        self.bar.begin()
        self._show_parts(working=True)

    def show_compared(self, compared: Compared, name: str, limit_deg: float, *, may_map: bool) -> None:
        """Show a result; ``limit_deg`` as it was set before, ``may_map`` whether columns or markers can be told."""
        compared = in_order(compared)
        self.compared, self.limit_deg = compared, limit_deg
        self.facts.setText(f"{name} · {say(compared.kind)}")
        self.facts.setToolTip(self.facts.text())
        sentence, basis = headline(compared, limit_deg)
        self.answer.setText(sentence)
        self.basis.setText(basis)
        self.other_button.set_face(self.tr("Other &reference…"))
        self.columns_button.setVisible(may_map)
        before, names = self.angle.currentData(), [pairs.name for pairs in compared.pairs]
        chosen = before if before in names else most_moved(compared).name
        self.angle.offer([(name, angle_name(name)) for name in names], chosen)
        self._fill_joined(compared)
        self.table.show_compared(compared, limit_deg)
        self._show_parts(working=False)
        self._show_plot()

    def first(self) -> QWidget:
        if self.compared is not None:
            return self.angle
        return self.stop_button if self._work.isVisibleTo(self) else self.other_button

    def next_view(self) -> None:
        """Differences and curves in turn."""
        values = ["differences", "curves"]
        self.view.choose(values[1 - values.index(str(self.view.value()))])
        self._show_plot()

    def _show_parts(self, *, working: bool) -> None:
        shown = self.compared is not None
        self._work.setVisible(working)
        self._body.setVisible(shown)
        self.save_button.setEnabled(shown)
        self.other_button.setEnabled(not working)
        self.columns_button.setEnabled(not working)
        layout = self.layout()
        assert isinstance(layout, QVBoxLayout)
        layout.setStretch(layout.count() - 1, 0 if shown else 1)

    def _show_plot(self) -> None:
        name = self.angle.currentData()
        found = self.compared.pairs if self.compared is not None else ()
        pairs = next((one for one in found if one.name == name), None)
        if pairs is None or self.compared is None:
            self.chart.show_plot(None)
            return
        view: View = "curves" if self.view.value() == "curves" else "differences"
        self.chart.show_plot(AgreementPlot(pairs, self.limit_deg, self.compared.shift is not None, view))

    def _fill_joined(self, compared: Compared) -> None:
        body, theme = self._joined.body, self._theme
        empty(body)
        remarks = remark_words(compared)
        if remarks:
            body.addWidget(Text(theme, self.tr("Look at this first"), 16, SEMIBOLD, wrap=True))
            for words in remarks:
                body.addWidget(Text(theme, words, 14, REGULAR, "warn", wrap=True))
            body.addWidget(Line(theme))
        body.addWidget(Text(theme, self.tr("How they were brought together"), 16, SEMIBOLD, wrap=True))
        for state, thing, value, small in joined_rows(compared):
            body.addWidget(Line(theme))
            row = QWidget()
            grid = in_grid(8, 0, margins=(0, 0, 0, 0), within=row)
            grid.addWidget(Sign(theme, state), 0, 0)
            grid.addWidget(Text(theme, thing, 14, REGULAR, "text2"), 0, 1)
            grid.addWidget(Text(theme, value, 14, SEMIBOLD), 0, 2, Qt.AlignmentFlag.AlignRight)
            grid.addWidget(caption(theme, small, wrap=True), 1, 1, 1, 2)
            grid.setColumnStretch(1, 1)
            body.addWidget(row)
        left = left_words(compared)
        if left:
            body.addWidget(Line(theme))
            body.addWidget(Text(theme, self.tr("Not used"), 14, REGULAR, "text2"))
            for words in left:
                body.addWidget(caption(theme, words, wrap=True))
        body.addStretch(1)


COLUMNS = 7
COLUMN_SHARES = (20, 18, 20, 7, 15, 9, 21)
STATE_TOKEN = {"good": "good", "warn": "warn", "bad": "bad"}


class AgreementTable(QWidget):
    """Rows of texts; the interval of a figure stands below it."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._grid = in_grid(12, 3, shares=COLUMN_SHARES, margins=(0, 0, 0, 0), within=self)

    def show_compared(self, compared: Compared, limit_deg: float) -> None:
        empty(self._grid)
        heads = (
            self.tr("Angle"), self.tr("Mean difference"), self.tr("Limits of agreement"), self.tr("RMSE"),
            self.tr("ICC(2,1)"), self.tr("Curve match"), self.tr("In words"),
        )  # fmt: skip
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column)
        for number, pairs in enumerate(compared.pairs):
            row = 3 * number + 1
            self._grid.addWidget(Line(self._theme), row, 0, 1, COLUMNS)
            self._add_row(row + 1, pairs, limit_deg, readings=compared.shift is None)

    def _add_row(self, row: int, pairs: Pairs, limit_deg: float, *, readings: bool) -> None:
        theme, name, figures = self._theme, pairs.name, pairs.figures_deg
        state, words = judgement_words(pairs, limit_deg, readings=readings)
        first = (
            named_by_color(theme, angle_name(name), angle_token(name)),
            Text(theme, signed(figures.bias, name), 14, SEMIBOLD, wrap=True),
            Text(theme, limits(figures, name), 14, REGULAR, wrap=True),
            Text(theme, tenths(figures.rmse), 14, SEMIBOLD),
            Text(theme, share(figures.icc), 14, SEMIBOLD),
            Text(theme, share(figures.cmc), 14, REGULAR),
            _Judged(theme, state, words),
        )
        low, high = figures.icc_interval
        icc = self.tr("{low} to {high}").format(low=share(low), high=share(high)) if low == low else ""
        second = {1: interval(figures.bias_interval, name), 4: icc}
        for column, widget in enumerate(first):
            spans = 1 if column in second else 2
            self._grid.addWidget(widget, row, column, spans, 1, Qt.AlignmentFlag.AlignVCenter)
        for column, text in second.items():
            self._grid.addWidget(caption(theme, f"({text})" if text else "", wrap=True), row + 1, column)


class _Judged(QWidget):
    """Sign and words, which may need two lines."""

    def __init__(self, theme: Theme, state: State, words: str) -> None:
        super().__init__()
        row = QGridLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setHorizontalSpacing(8)
        row.addWidget(Sign(theme, state), 0, 0, Qt.AlignmentFlag.AlignTop)
        row.addWidget(Text(theme, words, 14, SEMIBOLD, STATE_TOKEN.get(state, "text2"), wrap=True), 0, 1)
        row.setColumnStretch(1, 1)
