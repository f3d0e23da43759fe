"""Two sessions: the card of their differences with its table, and the card of their mean repetitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.results.motion_curves import Quantity
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line, named_by_color
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import (
    NO_LIMIT_PX,
    STRETCH,
    ScrollArea,
    ScrolledColumn,
    empty,
    fill,
    in_column,
    in_grid,
    in_line,
)
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Sign, Text, caption, plain_tooltip
from carpus.ui.keys import Keys
from carpus.ui.plot.beside import BesidePlot
from carpus.ui.plot.card import StillPlot
from carpus.ui.plot.style import screen_style
from carpus.ui.report.beside_shown import Shown, Watched, kinds
from carpus.ui.report.beside_words import BesideRow, facts_words, heads, other_hand_words, quantity_name, table_rows
from carpus.ui.theme import Theme
from carpus.ui.verdicts import limit_words


class DifferencesCard(Card):
    """``followed`` chooses what of the whole hand is looked at, ``mirror_button`` how a left hand is shown."""

    def __init__(self, theme: Theme, keys: Keys) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self._facts = ElidedText(theme, "", 14, REGULAR, "text2")
        self.followed = Combo()
        self.followed.setAccessibleName(self.tr("What is compared"))
        self.followed.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button = Button(theme, self.tr("&Mirror"), "quiet", hint=keys["mirror"])
        self.mirror_button.setCheckable(True)
        self.mirror_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.mirror_button.setToolTip(self.tr("Show the left hand as it would look as a right one"))
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.table = BesideTable(theme)
        self._limits = caption(theme, wrap=True)
        named = in_column(Text(theme, self.tr("Differences"), 20, SEMIBOLD), self._facts, gap=0)
        self._title_row = in_line((named, 1), self.followed, self.mirror_button, self.export_button, gap=12)
        self.body.setContentsMargins(24, 10, 16, 10)
        self.body.setSpacing(4)
        self.body.addLayout(self._title_row)
        self._column = ScrolledColumn()
        in_column(self.table, self._limits, STRETCH, gap=8, margins=(0, 0, 8, 0), within=self._column)
        self._scroll = ScrollArea(self._column, Qt.FocusPolicy.TabFocus)  # so that keys scroll it
        self._scroll.setAccessibleName(self.tr("Differences"))
        self.body.addWidget(self._scroll, 1)

    def fit(self, *, tight: bool, shown: bool) -> None:
        """No higher than what is in it, and with large text no lower, with fewer words at the button."""
        self._scroll.unroll(on=tight)
        self.export_button.set_face(self.export_button.text(), hint="" if tight else "Ctrl+E")
        self._scroll.setMinimumHeight(self._theme.px(70))
        needed = self._column.sizeHint().height()
        if self._column.hasHeightForWidth():
            needed = self._column.heightForWidth(max(self._scroll.width() - 16, 1))
        margins = self.body.contentsMargins()
        around = self._title_row.sizeHint().height() + self.body.spacing() + margins.top() + margins.bottom()
        self.setMaximumHeight(max(needed, self._theme.px(70)) + around + 4 if shown and not tight else NO_LIMIT_PX)

    def clear(self) -> None:
        self.table.show_rows((), ())
        self._facts.setText("")
        self._limits.setText("")
        self._offer([])
        self.mirror_button.hide()

    def show_sessions(self, watched: tuple[Watched, Watched]) -> None:
        """What can be looked at of two sessions, and whether one of them can be mirrored."""
        self._offer(kinds(*watched))
        sides = [one.figures.side for one in watched]
        self.mirror_button.setVisible("left" in sides)
        self.mirror_button.blockSignals(True)
        self.mirror_button.setChecked(sides[0] != sides[1])
        self.mirror_button.blockSignals(False)

    def _offer(self, found: list[tuple[str, str]]) -> None:
        self.followed.offer(found)
        self.followed.setVisible(bool(found))

    def show_differences(self, now: Shown) -> None:
        facts = facts_words(now.both)
        self._facts.setText(facts)
        self._facts.setToolTip(plain_tooltip(facts))
        self.table.show_rows(heads(now.both), table_rows(now.both, whole_hand=bool(now.followed)))
        words = [limit_words(now.both.first.study)]
        if now.both.relation == "hands":
            words.append(other_hand_words())
        self._limits.setText(" ".join(words))


COLUMN_SHARES = (20, 17, 17, 13, 8, 34)
RIGHT = (3, 4)
"""Columns whose figures end at the right."""


class BesideTable(QWidget):
    """Rows of texts in columns."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.rows: tuple[BesideRow, ...] = ()
        self._grid = in_grid(16, 5, shares=COLUMN_SHARES, margins=(0, 0, 0, 0), within=self)

    def show_rows(self, heads: Sequence[str], rows: Sequence[BesideRow]) -> None:
        empty(self._grid)
        self.rows = tuple(rows)
        for column, head in enumerate(heads):
            self._grid.addWidget(caption(self._theme, head, wrap=True), 0, column, self._side(column))
        for number, row in enumerate(rows):
            self._grid.addWidget(Line(self._theme), 2 * number + 1, 0, 1, len(COLUMN_SHARES))
            self._add_row(2 * number + 2, row)
        self.setAccessibleName("; ".join(f"{row.movement} {row.first} {row.second} {row.words}" for row in rows))

    @staticmethod
    def _side(column: int) -> Qt.AlignmentFlag:
        across = Qt.AlignmentFlag.AlignRight if column in RIGHT else Qt.AlignmentFlag(0)
        return across | Qt.AlignmentFlag.AlignVCenter

    def _add_row(self, line: int, row: BesideRow) -> None:
        theme = self._theme
        weak = "text" if row.strong else "text2"
        said = SEMIBOLD if row.strong else REGULAR
        cells: tuple[QWidget, ...] = (
            named_by_color(theme, row.movement, row.token),
            Text(theme, row.first, 16, SEMIBOLD, wrap=True),
            Text(theme, row.second, 16, SEMIBOLD, wrap=True),
            Text(theme, row.difference, 14, said, weak),
            Text(theme, row.error, 14, REGULAR, "text2"),
            _Said(theme, row),
        )
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, line, column, self._side(column) if column in RIGHT else Qt.AlignmentFlag(0))


class _Said(QWidget):
    def __init__(self, theme: Theme, row: BesideRow) -> None:
        super().__init__()
        line = in_line(
            (Sign(theme, row.state), 0, Qt.AlignmentFlag.AlignVCenter), gap=8, margins=(0, 0, 0, 0), within=self
        )
        strong = SEMIBOLD if row.strong else REGULAR
        line.addWidget(Text(theme, row.words, 14, strong, "text" if row.strong else "text2", wrap=True), 1)


class MeanCard(Card):
    """``chosen``: another angle; ``sought`` carries a share of the repetition that was pointed at."""

    chosen = Signal()
    sought = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 0)
        self._shown: Shown | None = None
        self.title = Text(theme, self.tr("Mean repetition, ± sd"), 14, SEMIBOLD)
        self._quantities = Combo()
        self._quantities.setAccessibleName(self.tr("Angle"))
        self._quantities.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves Space and the arrows to the player
        self._quantities.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        self.curves = MeanCurves(theme)
        head = in_line(self.title, STRETCH, self._quantities, gap=12)
        self.body.setContentsMargins(20, 8, 16, 10)
        self.body.setSpacing(4)
        fill(self.body, head, (self.curves, 1))
        self.curves.sought.connect(self.sought)
        self._quantities.currentIndexChanged.connect(lambda _: self._choose())

    @property
    def quantity(self) -> Quantity:
        assert self._shown is not None
        return self._shown.quantities[max(self._quantities.currentIndex(), 0)]

    def show_means(self, now: Shown | None, finger: int = 0) -> None:
        """What can be chosen of two sessions, and the curves of a finger or of their main angle; nothing while they are
        read."""
        self._shown = now
        self._quantities.setEnabled(now is not None)
        quantities = [] if now is None else [(one, quantity_name(one)) for one in now.quantities]
        self._quantities.offer(quantities, None if now is None else now.quantity_of(finger))
        self.curves.show_plot(None if now is None else now.plot(self.quantity))

    def _choose(self) -> None:
        if self._shown is not None:
            self.curves.show_plot(self._shown.plot(self.quantity))
            self.chosen.emit()


class MeanCurves(StillPlot):
    """Paints one plot, or nothing."""

    sought = Signal(float)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.plot: BesidePlot | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(self.tr("Mean repetition of both sessions"))
        theme.changed.connect(self.update)

    def show_plot(self, plot: BesidePlot | None) -> None:
        self.plot = plot
        self.show_painted(None if plot is None else plot.paint)

    def show_shares(self, shares: tuple[float, float]) -> None:
        if self.plot is not None and shares != self.plot.shares:
            self.show_plot(replace(self.plot, shares=shares))

    def sizeHint(self) -> QSize:
        return QSize(540, 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self._theme.px(300), self._theme.px(104))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self.plot is not None and event.button() == Qt.MouseButton.LeftButton:
            panel = self.plot.panel(screen_style(self._theme), QRectF(self.rect()))
            share = (event.position().x() - panel.box.left()) / max(panel.box.width(), 1.0)
            if -0.02 <= share <= 1.02:
                self.sought.emit(min(max(share, 0.0), 1.0))
