"""Two sessions side by side as tables for other programs: the differences, and the mean repetitions beside them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from carpus.core.results.figures import SessionFigures
from carpus.core.results.ranges import RangeRow
from carpus.core.results.side_by_side import ComparedRange, SideBySide
from carpus.ui.beside.shown import Shown
from carpus.ui.beside.words import column_of
from carpus.ui.saved_table import named_beside, save_table

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
