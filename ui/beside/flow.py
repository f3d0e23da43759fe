"""The flow of two sessions side by side: which two, from where, what is printed and written of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from carpus.core.provenance import with_revision
from carpus.core.records.values import SessionEntry
from carpus.core.results.figures import SessionFigures
from carpus.core.results.ranges import RangeRow
from carpus.core.results.side_by_side import ComparedRange, SideBySide
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.report.beside_page import BesideReport
from carpus.ui.report.beside_shown import Shown
from carpus.ui.report.beside_words import column_of
from carpus.ui.saved_table import named_beside, save_table
from carpus.ui.sessions.sheets import ChooseSheet


class BesideFlow(Flow):
    """``back_to`` is where one came from."""

    place, guide, tab = "beside", "sessions", "review"
    screen: BesideScreen

    def __init__(self, context: ScreenContext) -> None:
        self._background = Background()  # its own: what the list still reads holds up no picture
        super().__init__(context, BesideScreen(context.theme, context.keys, self._background, context.library))
        screen, tell = self.screen, context.messages
        self.back_to = "sessions"
        self.sheet = ChooseSheet(context.shell, context.theme)
        self.sheet.chosen.connect(self._take_other)
        screen.told.connect(tell.fault)
        screen.report.connect(self._print)
        screen.export.connect(self._export)
        screen.other.connect(self._ask_other)

    def show(self, one: str, other: str, finger: int = 0) -> None:
        """Show two sessions, of the whole hand a ``finger`` first; Back leads to where one is now."""
        if self.context.way.place != "beside":
            self.back_to = self.context.way.place
        patient = self.context.now.patient
        self.screen.begin((one, other), patient.side if patient is not None else "", finger)
        self.context.way.go("beside")

    def up(self) -> None:
        patient = self.context.now.patient
        if self.back_to == "review" or patient is None:
            self.to_session()
        else:
            self.context.way.show("sessions", patient.patient_id)

    def leave(self) -> None:
        self.screen.playing.stop()

    def close(self) -> None:
        self.screen.playing.stop()
        self._background.wait()

    def sign_lines(self) -> list[str]:
        shown = self.screen.shown
        both = None if shown is None or self.context.now.is_practice else shown.both
        simulated = both is not None and (both.first.simulated or both.second.simulated)
        return [self.tr("Simulated hand: this is not a patient’s, and does not count.")] if simulated else []

    def _print(self, now: Shown) -> None:
        pseudonym = self.context.now.name or now.both.first.subject_id
        made_by = with_revision(self.context.version)
        therapist = self.context.report.therapist
        report = BesideReport(now, self.screen.mean.quantity, pseudonym, therapist, made_by)
        self.context.way.show("report", report, [figures.session_id for figures in report.sessions])

    # --- another session in place of the second ------------------------------------------------------------
    def _ask_other(self) -> None:
        patient = self.context.now.patient
        entries = self.context.library.sessions(patient.patient_id) if patient and patient.patient_id else ()
        first, second = self.screen.ids
        others = [entry for entry in entries if entry.session_id not in (first, second)]
        what = {entry.session_id: _entry_words(entry, entries) for entry in entries}
        self.sheet.begin(
            self.tr("With which session?"),
            self.tr("{session} stays.").format(session=what.get(first, self.tr("The first one"))),
            self.tr("Compare"),
            [(entry.session_id, what[entry.session_id]) for entry in others],
        )

    def _take_other(self, session_id: str) -> None:
        if session_id and session_id != "None":
            self.show(self.screen.ids[0], session_id)

    # --- tables -------------------------------------------------------------------------------------------
    def _export(self, now: Shown) -> None:
        title, kinds = self.tr("Save tables"), "CSV (*.csv)"
        path = self.ask_where_to_save("exports", "side-by-side.csv", title, kinds)
        if path is not None:
            target = path if path.suffix else path.with_suffix(".csv")
            replaces = target.exists()
            sessions = [now.both.first.session_id, now.both.second.session_id]
            self.run(
                lambda: write_tables(target, now, replaces=replaces), lambda paths: self.tell_made(paths, sessions)
            )


def _entry_words(entry: SessionEntry, entries: Sequence[SessionEntry]) -> str:
    """``20 Nov 2026, 11:37 · Wrist flexion–extension · Right hand``."""
    when = numbers.report_date(entry.recorded, *(other.recorded for other in entries))
    return " · ".join((when, terms.exercise_name(entry.exercise), terms.hand_name(entry.hand)))


HEAD = (
    "movement", "angle", "first_session", "first_hand", "first_created", "first_exercise", "first_mean_deg",
    "first_sd_deg", "first_n", "first_at_least", "second_session", "second_hand", "second_created", "second_exercise",
    "second_mean_deg", "second_sd_deg", "second_n", "second_at_least", "difference_deg", "error_deg", "verdict",
    "not_judged_for",
)  # fmt: skip
CURVES_HEAD = (
    "angle", "share", "first_mean_deg", "first_sd_deg", "first_n", "second_mean_deg", "second_sd_deg", "second_n",
)  # fmt: skip


def write_tables(path: Path, shown: Shown, *, replaces: bool) -> list[Path]:
    """Write the differences into ``path`` and the curves beside it; the files. ``replaces`` whether a person was asked
    for the first; a second file that is there already is never replaced unless the first was. Raises
    :class:`OutputNotWritable`."""
    beside = named_beside(path, "-curves", replaces=replaces)
    rows = [_row(one, shown.both) for one in shown.both.ranges]
    rows += [_row_alone(row, shown.both, is_first=is_first) for row, is_first in shown.both.alone]
    save_table(path, HEAD, rows)
    save_table(beside, CURVES_HEAD, _curve_rows(shown))
    return [path, beside]


def _row(one: ComparedRange, both: SideBySide) -> Sequence[str]:
    item = one.comparison
    sides = [*_side(both.first, one.first), *_side(both.second, one.second)]
    verdict = item.verdict
    if both.relation == "hands" and one.beyond:
        verdict = "less" if item.difference_deg < 0.0 else "more"  # type: ignore[assignment]
    name = one.first.joint or column_of(("", one.first.angle))
    return [
        item.movement, name, *sides, _decimal(item.difference_deg), _decimal(item.limit_deg), verdict,
        " ".join(item.reasons),
    ]  # fmt: skip


def _row_alone(row: RangeRow, both: SideBySide, *, is_first: bool) -> Sequence[str]:
    """What only one of the two has."""
    sides = [*_side(both.first, row if is_first else None), *_side(both.second, None if is_first else row)]
    name = row.joint or column_of(("", row.angle))
    return [row.movement, name, *sides, "", "", "not_judged", " ".join(both.reasons or ("unknown",))]


def _side(figures: SessionFigures, row: RangeRow | None) -> list[str]:
    """The columns of one session; its figures are empty where it has none."""
    who = [figures.session_id, figures.side, figures.when.isoformat(), figures.exercise.id]
    if row is None:
        return [*who, "", "", "", ""]
    return [*who, _decimal(row.mean_deg), _decimal(row.sd_deg), str(row.count), "yes" if row.limited else ""]


def _curve_rows(shown: Shown) -> Iterable[Sequence[str]]:
    for quantity in shown.quantities:
        for share, *rest in shown.plot(quantity).rows():
            cells = [str(value) if isinstance(value, int) else _decimal(value) for value in rest]
            yield [column_of(quantity), f"{share:.2f}", *cells]


def _decimal(value: float) -> str:
    return f"{value:.1f}" if math.isfinite(value) else ""
