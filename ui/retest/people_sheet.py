"""Who takes part in the test and retest: ticks in the list of everybody."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.ui.controls.button import Button
from carpus.ui.controls.column import RING_PX, scroll_area
from carpus.ui.controls.host import host_of
from carpus.ui.controls.layouts import STRETCH, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.controls.tick import Tick
from carpus.ui.theme import Theme


class PeopleSheet(Sheet):
    """``chosen`` carries the identities of all who take part."""

    chosen = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        body.addWidget(Text(theme, self.tr("Who takes part?"), 20, SEMIBOLD, wrap=True))
        words = self.tr(
            "Volunteers or staff whose hands do not change, never patients. Add them under Patients, by a pseudonym "
            "such as P01. Each is measured twice or more within 14 days, all discs taken off and put on anew."
        )
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self._scroll = scroll_area(QWidget())
        body.addWidget(self._scroll)
        self.ticks: dict[str, Tick] = {}
        close = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=44)
        self.take = Button(theme, self.tr("These take part"), "primary", height_px=44)
        body.addLayout(in_line(STRETCH, close, self.take, gap=10))
        close.clicked.connect(self.close_sheet)
        self.take.clicked.connect(self._take)
        self.set_default(self.take)

    def begin(self, people: Sequence[tuple[str, str, int]], chosen: Sequence[str]) -> None:
        """Identity, pseudonym and number of sessions of everybody, and who takes part already."""
        rows = QWidget()
        column = in_column(gap=2, margins=(RING_PX, RING_PX, RING_PX + 8, RING_PX), within=rows)
        self.ticks = {}
        for identity, name, sessions in people:
            count = self.tr("1 session") if sessions == 1 else self.tr("{count} sessions").format(count=sessions)
            tick = Tick(self._theme, f"{name.replace('&', '&&')} · {count}")
            tick.setChecked(identity in chosen)
            column.addLayout(in_line(tick, STRETCH))
            self.ticks[identity] = tick
        if not people:
            column.addWidget(Text(self._theme, self.tr("Nobody is in the list yet."), 14, REGULAR, "text2"))
        column.addStretch(1)
        self._scroll.setWidget(rows)
        self._take_room()
        self.open(next(iter(self.ticks.values()), self.take))

    def _take_room(self) -> None:
        super()._take_room()
        rows = self._scroll.widget() if hasattr(self, "_scroll") else None  # while the sheet is being made
        if rows is not None:
            room = host_of(self).height() - self._theme.px(320)
            self._scroll.setFixedHeight(max(min(rows.sizeHint().height(), room), self._theme.px(80)))

    def _take(self) -> None:
        self.close_sheet()
        self.chosen.emit([identity for identity, tick in self.ticks.items() if tick.isChecked()])
