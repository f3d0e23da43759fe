"""With what a session is compared: a file of another measurement or another session; which of its columns is which."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QSizePolicy, QWidget

from carpus.core.hand.protocols import PALM_MARKERS
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Choices, Combo, Labelled
from carpus.ui.controls.layouts import RING_PX, STRETCH, ScrollArea, fill, host_of, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, SEMIBOLD, Text
from carpus.ui.marker_words import marker_name
from carpus.ui.ports import ReferenceChoice
from carpus.ui.theme import Theme
from carpus.ui.translate import tr
from carpus.ui.words.agreement import angle_name

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.reference import ReferenceOutline

LEAST_DISCS = 3


class ReferenceSheet(Sheet):
    """``file_wanted`` asks for a file, ``session_wanted`` carries the identity of another session."""

    file_wanted = Signal()
    session_wanted = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        body = self.card.body
        words = self.tr(
            "The same movement, measured by something else at the same time: markers (C3D, TRC), angles (MOT, STO, or "
            "a CSV table), a list of goniometer readings (CSV), or another result."
        )
        self.head(self.tr("Compare this session with what?"), words, gap=8)
        body.addSpacing(8)
        self.file_button = Button(theme, self.tr("Choose a &file…"), "primary", icon="folder-open")
        self.box = Combo()
        self._other = Labelled(theme, self.tr("Or another session of this &patient"), self.box)
        self.session_button = Button(theme, self.tr("Compare with this &session"))
        close = Button(theme, self.tr("Cancel"), "quiet", hint=self.tr("Esc"))
        fill(body, self.file_button, 8, self._other)
        body.addLayout(in_line(close, STRETCH, self.session_button))
        close.clicked.connect(self.close_sheet)
        self.file_button.clicked.connect(self._take_file)
        self.session_button.clicked.connect(self._take_session)
        self.set_default(self.file_button)

    def begin(self, sessions: Sequence[tuple[str, str]]) -> None:
        """Ask; ``sessions`` are identity and words of those there are besides."""
        self.box.offer(sessions)
        for widget in (self._other, self.session_button):
            widget.setVisible(bool(sessions))
        self.open()

    def _take_file(self) -> None:
        self.close_sheet()
        self.file_wanted.emit()

    def _take_session(self) -> None:
        self.close_sheet()
        self.session_wanted.emit(str(self.box.currentData()))


class ColumnsSheet(Sheet):
    """Which marker or column of a file is which of ours; ``wanted`` carries the whole :class:`ReferenceChoice`."""

    wanted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 640)
        self.head(gap=8)
        self.problem = Text(theme, "", 14, SEMIBOLD, "warn", wrap=True)
        self.unit = Choices(
            theme, [(None, self.tr("As the file says")), (False, self.tr("Degrees")), (True, self.tr("Radians"))]
        )
        kept = self.problem.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # so that nothing jumps when all is said
        self.problem.setSizePolicy(kept)
        self._scroll = ScrollArea(QWidget())
        self.boxes: dict[str, QComboBox] = {}
        self.signs: dict[str, Tick] = {}
        self._outline: ReferenceOutline | None = None
        self._choice = ReferenceChoice("")
        self.take = Button(theme, self.tr("Compare"), "primary", height_px=44)
        fill(self.card.body, self._scroll, self.unit, self.problem)
        self.answer_row(self.take)
        self.take.clicked.connect(self._take)

    def begin(self, outline: ReferenceOutline, ours: Sequence[str], choice: ReferenceChoice) -> None:
        """Ask for every one of ``ours``; what its names tell, or was said before, is chosen already."""
        self._outline, self._choice = outline, choice
        points = outline.kind == "points"
        self.title.setText(self.tr("Which marker is which?") if points else self.tr("Which column is which?"))
        words = (
            self.tr("Of {file}: at least three discs of the palm. Leave the others open.")
            if points
            else self.tr("Of {file}: the time, and at least one angle. Leave the others open.")
        )
        self.words.setText(words.format(file=Path(choice.path).name))
        said = dict(outline.found) | dict(choice.markers if points else choice.columns)
        self._fill(outline, ours, said, points)
        self.unit.setVisible(not points)
        self.unit.choose(choice.radians)
        self._check()
        self.open(next(iter(self.boxes.values())))

    def _fill(self, outline: ReferenceOutline, ours: Sequence[str], said: dict[str, str], points: bool) -> None:
        rows = QWidget()
        grid = QGridLayout(rows)
        grid.setContentsMargins(RING_PX, RING_PX, RING_PX + 8, RING_PX)
        grid.setColumnStretch(1, 1)
        self.boxes, self.signs = {}, {}
        for number, name in enumerate(ours):
            words = marker_name(name) if points else self.tr("Time") if name == "time" else angle_name(name)
            box = Combo()
            box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            box.setAccessibleName(words)
            own = outline.found.get("time", "") if name == "time" else ""  # MOT has times that are no column of its
            names = outline.names if not own or own in outline.names else (own, *outline.names)
            chosen = said.get(name, "")
            box.offer([("", "–"), *zip(names, names, strict=True)], chosen.removeprefix("-"))
            box.currentIndexChanged.connect(lambda _: self._check())
            label = Text(self._theme, words, 14, MEDIUM)
            label.setBuddy(box)
            grid.addWidget(label, number, 0)
            grid.addWidget(box, number, 1)
            self.boxes[name] = box
            if not points and name != "time":
                sign = Tick(self._theme, self.tr("other sign"))
                sign.toggled.connect(lambda _, sign=sign, words=words: _name_sign(sign, words))
                sign.setChecked(chosen.startswith("-"))
                _name_sign(sign, words)
                grid.addWidget(sign, number, 2)
                self.signs[name] = sign
        self._scroll.setWidget(rows)
        self._take_room()

    def _take_room(self) -> None:
        super()._take_room()
        rows = self._scroll.widget() if hasattr(self, "_scroll") else None  # while the sheet is being made
        if rows is not None:
            room = host_of(self).height() - self._theme.px(320)
            self._scroll.setFixedHeight(max(min(rows.sizeHint().height(), room), self._theme.px(100)))

    def chosen(self) -> dict[str, str]:
        """Ours to theirs, a minus before what turns its sign."""
        out = {}
        for name, box in self.boxes.items():
            if box.currentData():
                turned = name in self.signs and self.signs[name].isChecked()
                out[name] = ("-" if turned else "") + str(box.currentData())
        return out

    def _check(self) -> None:
        if self._outline is None:
            return
        lacking = missing(self._outline, self.chosen())
        self.problem.setText(lacking_words(lacking))
        self.problem.setVisible(bool(lacking))
        self.take.setEnabled(not lacking)

    def _take(self) -> None:
        if self.take.isEnabled() and self._outline is not None:
            self.close_sheet()
            said = self.chosen()
            points = self._outline.kind == "points"
            radians = self.unit.value()
            assert radians is None or isinstance(radians, bool)
            self.wanted.emit(
                replace(
                    self._choice, markers=said if points else {}, columns={} if points else said,
                    radians=None if points else radians,
                )
            )  # fmt: skip


def _name_sign(sign: Tick, angle: str) -> None:
    sign.setAccessibleName(tr("{name}, other sign").format(name=angle))


def missing(outline: ReferenceOutline, said: dict[str, str]) -> str:
    """What must be said before anything can be compared: ``discs``, ``time``, ``angle``; empty for nothing."""
    if outline.kind == "points":
        return "" if len([name for name in PALM_MARKERS if name in said]) >= LEAST_DISCS else "discs"
    if outline.kind == "angles":
        return "time" if "time" not in said else "" if len(said) > 1 else "angle"
    return ""


def lacking_words(lacking: str) -> str:
    """The same for the person."""
    return {
        "discs": tr("Three discs of the palm are needed."),
        "time": tr("The column of the times is needed."),
        "angle": tr("At least one angle is needed."),
    }.get(lacking, "")
