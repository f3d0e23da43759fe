"""Tables for a spreadsheet of a region hold the same numbers as those for programs, by that region's own rules."""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QLocale

from carpus.core.formats.csv_tables import write
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect
from carpus.core.formats.table_read import read_table
from carpus.core.model.hand.protocols import HAND21, WRIST6
from carpus.core.session.reader import read_session
from carpus.ui.kit.table_file import OFFERED_REGIONS, regional_table_form, save_table
from tests.commands import Command
from tests.formats.takes import build_take, store_session


def cells(path: Path, form: TableDialect) -> list[list[str]]:
    with path.open(encoding="utf-8", newline="") as file:
        assert file.read(1) == "\ufeff" or not form.has_bom
        file.seek(0)
        rows = list(csv.reader(file, delimiter=form.separator))
    rows[0][0] = rows[0][0].removeprefix("\ufeff")
    return rows


def read_as(cell: str, region: str) -> float | str:
    """What a spreadsheet of the region takes a cell for: a number by its decimal and thousands signs, else a text."""
    value, is_number = QLocale(region).toDouble(cell)
    return value if is_number else cell


def as_python(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell


@pytest.mark.parametrize(
    ("exercise", "name", "off_deg"),
    [("FOREARM_PS", "supination_from_thumb_up", -90.0), ("WRIST_FE", "rotation_from_start", 0.0)],
)
def test_spreadsheet_forearm_counts_clinically(exercise: str, name: str, off_deg: float, tmp_path: Path) -> None:
    session = read_session(store_session(tmp_path, WRIST6))
    session = replace(session, header=replace(session.header, exercise=exercise))
    start_deg = math.degrees(session.calibration.start_angles_rad[2])
    take = build_take(session, "s")
    write(take, tmp_path / "plain")
    write(replace(take, dialect=regional_table_form("en_GB")), tmp_path / "sheet")
    plain = cells(tmp_path / "plain" / "s.wrist.for-programs.csv", MACHINE_DIALECT)
    sheet = cells(tmp_path / "sheet" / "s.wrist.csv", regional_table_form("en_GB"))
    column = plain[0].index("filter_pronosupination_deg")
    assert sheet[0][column] == f"filter_{name}_deg"
    assert not any("pronosupination" in one for one in sheet[0])
    stored_deg, read_deg = (float(rows[1][column]) for rows in (plain, sheet))
    assert read_deg == pytest.approx(stored_deg + off_deg - (start_deg if not off_deg else 0.0), abs=1e-3)


@pytest.mark.parametrize("region", OFFERED_REGIONS)
def test_spreadsheet_of_region_reads_same_numbers(region: str, tmp_path: Path) -> None:
    assert regional_table_form("it-IT") == regional_table_form("fr") == TableDialect(";", ",", has_bom=True)
    take, form = build_take(read_session(store_session(tmp_path, HAND21)), "s"), regional_table_form(region)
    plain = [path for path in write(take, tmp_path / "plain") if path.suffix == ".csv"]
    assert all(path.name.endswith(".for-programs.csv") for path in plain)
    numbers = 0
    for path in plain:
        wanted = cells(path, MACHINE_DIALECT)[:200]
        if not (tmp_path / region).exists():
            write(replace(take, dialect=form), tmp_path / region)
        found = cells(tmp_path / region / path.name.replace(".for-programs", ""), form)[:200]
        kept = [k for k, name in enumerate(wanted[0]) if "pronosupination" not in name]  # counted otherwise there
        wanted, found = ([[row[k] for k in kept] for row in rows] for rows in (wanted, found))
        for one, other in zip(wanted, found, strict=True):
            assert [read_as(cell, region) for cell in other] == [as_python(cell) for cell in one]
            numbers += sum(isinstance(as_python(cell), float) for cell in one)
    assert numbers > 1000


def test_export_command_writes_regional_tables(tmp_path: Path, command: Command) -> None:
    path = store_session(tmp_path)
    done = command("export", path, "--region", "de_DE", "--output", tmp_path / "out")
    assert done.code == 0
    (table,) = (tmp_path / "out").glob("*.measures.csv")
    assert table.read_bytes().startswith(b"\xef\xbb\xbfsession;")
    refused = command("export", path, "--region", "nowhere", "--output", tmp_path / "none")
    assert (refused.code, "no region is called “nowhere”" in refused.err) == (2, True)


def test_table_saved_in_window_has_regional_dialect(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carpus.ui.kit.table_file.user_region", lambda: "it_IT")
    save_table(tmp_path / "t.csv", ("angle", "mean_deg"), [("flexion", -1.5), ("=1+1", 91.947)])
    assert (tmp_path / "t.csv").read_text(encoding="utf-8-sig").split() == [
        "angle;mean_deg", "flexion;-1,5", "'=1+1;91,947",
    ]  # fmt: skip
    assert read_table(tmp_path / "t.csv", ()).column("mean_deg") == ["-1,5", "91,947"]
