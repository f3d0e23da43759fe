"""``carpus track RECORDING... --output FOLDER``: the same sessions as one by one, faults told, begun again."""

from __future__ import annotations

import csv
import math
import os
import shutil
from dataclasses import fields
from pathlib import Path

import pyarrow
import pytest
from pyarrow import parquet

from carpus.app.commands.track_many import MEASURES_FILE, OUTCOMES_FILE
from carpus.core.formats import measures_table
from carpus.core.formats.measures_table import MeasureRow
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import CLICKS_FILE
from tests.commands import Command
from tests.rendered import DEVIATION, FLEXION, Rendered


@pytest.fixture(scope="module")
def made(rendered: Rendered, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two recordings, and one whose clicks are no clicks."""
    root = tmp_path_factory.mktemp("many")
    for place, spec in (("anna/first", DEVIATION), ("second", FLEXION), ("third", FLEXION)):
        shutil.copytree(rendered(spec), root / place)
    (root / "third" / CLICKS_FILE).write_text("{}")
    return root


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_batch_faults_are_collected_and_results_kept(made: Path, tmp_path: Path, command: Command) -> None:
    recordings = Path(shutil.copytree(made, tmp_path / "in"))
    out, table, other_table = tmp_path / "out", tmp_path / "all.parquet", tmp_path / "all.csv"
    words = ("track", recordings, "--output", out, "--exercise", "WRIST_RU", "--jobs", "2", "--no-smooth", "--table")
    done = command(*words, table)
    assert done.code == 1
    assert "hand is null" in done.out
    assert "tracked 2, done before 0, faults 1" in done.out
    told = {row["session"]: row for row in rows(out / OUTCOMES_FILE)}
    assert {name: row["outcome"] for name, row in told.items()} == {
        "anna/first.h5": "tracked", "second.h5": "tracked", "third.h5": "fault",
    }  # fmt: skip
    assert told["third.h5"]["tracked_share"] == ""
    assert not (out / "third.h5").exists()

    session = read_session(out / "anna" / "first.h5")
    assert session.header.exercise == "WRIST_RU"

    measures = rows(out / MEASURES_FILE)
    assert {row["session"] for row in measures} == {"anna/first.h5", "second.h5"}
    arc = next(row for row in measures if row["session"] == "anna/first.h5" and row["measure"] == "arc")
    wanted = compute_session_results(session).wrist_ranges[0]
    assert (arc["of"], arc["unit"]) == ("deviation", "deg")
    assert float(arc["mean"]) == pytest.approx(wanted.mean, rel=1e-5)
    assert arc["session_id"] == session.header.session_id
    assert arc["at_least"] in ("yes", "no")
    assert [(row["session"], row["measure"], row["of"]) for row in parquet.read_table(table).to_pylist()] == [
        (row["session"], row["measure"], row["of"]) for row in measures
    ]

    # Mended, and begun again with something that a killed process left: only what is missing is tracked.
    shutil.copy(recordings / "second" / CLICKS_FILE, recordings / "third" / CLICKS_FILE)
    left = out / ".third.h5.0123abcd.tmp"
    left.write_bytes(b"half")
    os.utime(left, (0, 0))
    before = {path: path.stat().st_mtime_ns for path in out.rglob("*.h5")}
    assert command(*words, table).code == 0
    assert {path: path.stat().st_mtime_ns for path in before} == before
    told = {row["session"]: row["outcome"] for row in rows(out / OUTCOMES_FILE)}
    assert told == {"anna/first.h5": "kept", "second.h5": "kept", "third.h5": "tracked"}
    measures = rows(out / MEASURES_FILE)
    assert {row["session"] for row in measures} == set(told)
    assert parquet.read_table(table).num_rows == len(measures), "begun again with the same table"
    assert not left.exists()
    assert sorted(path.name for path in out.iterdir()) == [
        "anna", MEASURES_FILE, OUTCOMES_FILE, "second.h5", "third.h5",
    ]  # fmt: skip

    # Sessions among them are tracked again, and say where they are from.
    again = tmp_path / "again"
    again.mkdir()
    assert command("track", out / "second.h5", "--output", again, "--no-smooth").code == 0
    assert read_session(again / "second.h5").header.origin == read_session(out / "second.h5").header.session_id
    done = command(*words, other_table, "--profile", "brisk")
    assert (done.code, done.out.count("tracked before with other settings")) == (0, 3)
    assert len(rows(other_table)) == len(measures), "what was tracked before is in it too"

    # What is no table of measures is somebody else's.
    parquet.write_table(pyarrow.table({"mine": [1]}), table)
    other_table.write_text("mine\n1\n")
    for path in (table, other_table):
        content = path.read_bytes()
        done = command(*words, path)
        assert (done.code, path.name in done.err) == (1, True)
        assert path.read_bytes() == content


def test_batch_foreign_table_is_not_replaced(made: Path, tmp_path: Path, command: Command) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / MEASURES_FILE).write_text("mine\n1\n")
    done = command("track", made, "--output", out)
    assert (done.code, MEASURES_FILE in done.err) == (1, True)
    assert (out / MEASURES_FILE).read_text() == "mine\n1\n"
    assert [path.name for path in out.iterdir()] == [MEASURES_FILE]


def test_table_holds_few_rows_in_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measures_table, "BATCH_ROWS", 5)
    kinds = {"str": "", "float": math.nan, "int": 0, "bool": False}
    row = MeasureRow(**{field.name: kinds[str(field.type)] for field in fields(MeasureRow)})  # type: ignore[arg-type]
    with measures_table.open_measures_file(tmp_path / "t.parquet") as take:
        for _ in range(4):
            take([row] * 3, ())
        assert (tmp_path / "t.parquet.half").exists(), "written as it comes"
    told = parquet.ParquetFile(tmp_path / "t.parquet").metadata
    assert (told.num_rows, told.num_row_groups) == (12, 2), "a group of six each"
