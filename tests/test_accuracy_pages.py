"""The tables of ``make accuracy`` find their places in the pages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.accuracy import __main__ as accuracy
from tests.accuracy import pages
from tests.accuracy.readings import WRIST_COLUMNS, Reading, ReadRow, patient_rows


def _reading(error_deg: float) -> Reading:
    error = np.full((10, 3), error_deg)
    return Reading(error, np.ones((10, 3)), error[:2], error[:0], error[0], np.zeros(3), 0, 60)


def test_whole_run_has_a_place_for_every_table() -> None:
    placed = [name for page in pages.PAGES for name in pages.find_tables(page.read_text(encoding="utf-8"))]
    assert len(placed) - placed.count("made") == len(set(placed)) - 1, "each table but the origin stands once"
    own = {name for name, _ in accuracy._patient_tables([])}
    told = accuracy.WRIST_ROWS.keys() | {"hand" if name == "hand" else f"{name} hand" for name in accuracy.HAND_ROWS}
    assert told | {f"{name} read" for name in told} | {"badly", "second", "made", *own} == set(placed)


def test_tables_are_put_between_the_marks_of_their_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page, printed = tmp_path / "page.md", tmp_path / "printed"
    page.write_text(
        f"# A\n\n{pages.mark_table('one', '| old |')}\n\nb\n\n{pages.mark_table('two', '| kept |')}\n", "utf-8"
    )
    new = r"| new | 50 \1 % |"
    printed.write_text(f"noise\n{pages.mark_table('one', new)}\n", "utf-8")
    monkeypatch.setattr(pages, "PAGES", (page,))
    assert pages.main([str(printed)]) == 0
    text = page.read_text("utf-8")
    assert new in text
    assert "| kept |" in text
    assert "old" not in text
    assert "noise" not in text
    printed.write_text(pages.mark_table("three", "| x |"), "utf-8")
    assert pages.main([str(printed)]) == 1
    assert page.read_text("utf-8") == text


def test_patient_table_pools_the_rows_of_a_kind() -> None:
    rows = [ReadRow(name, WRIST_COLUMNS, (_reading(error),)) for name, error in (("a", 3.0), ("b", 1.0))]
    line = patient_rows([("both", rows), ("none", [])])[-1]
    rmse = f"{np.sqrt(5.0):.2f}"
    assert line == ("both", "2", rmse, rmse, rmse, "-", "-", "50", "2.0", "3.0")
