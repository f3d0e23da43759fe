"""`carpus progress`: a patient's figures as CSV, Parquet and PDF, of the right patient alone."""

from __future__ import annotations

import csv
import io
import shutil
from pathlib import Path

import pytest
from pyarrow import parquet

from carpus.app.__main__ import main
from carpus.core.formats.measures_files import HEAD
from tests.formats.takes import stored


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "sessions").mkdir()
    stored(tmp_path / "sessions", frames=120, moving=True)
    shutil.copy(stored(tmp_path, frames=3), tmp_path / "sessions" / "two.h5")
    (tmp_path / "sessions" / "broken.h5").write_bytes(b"nothing")
    return tmp_path / "sessions"


def test_a_patients_figures_are_a_table(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["progress", "linden 42", "--sessions", str(folder / "one.h5")]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert tuple(rows[0]) == HEAD
    assert {row["subject_id"] for row in rows} == {"Linden 42"}
    assert any(row["of"] == "flexion" and row["measure"] == "arc" for row in rows)
    assert main(["progress", "Heron 17", "--sessions", str(folder)]) == 1
    assert "Heron 17" in capsys.readouterr().err


def test_it_is_written_as_csv_parquet_and_pdf(folder: Path, tmp_path: Path) -> None:
    out = [tmp_path / f"progress.{kind}" for kind in ("csv", "parquet", "pdf")]
    command = ["progress", "Linden 42", "--sessions", str(folder)]
    assert main([*command, *(word for path in out for word in ("--output", str(path)))]) == 0
    assert out[2].read_bytes().startswith(b"%PDF")
    table = parquet.read_table(out[1])
    with out[0].open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(table.column_names) == HEAD
    assert table.num_rows == len(rows)
    means = [float(row["mean"]) if row["mean"] else None for row in rows]
    for value, text in zip(table.column("mean").to_pylist(), means, strict=True):
        assert (text is None and value != value) or value == pytest.approx(text, rel=1e-5)
    assert main([*command, "--output", str(out[0])]) == 1, "nothing is overwritten"
    assert main(["progress", "all", "--sessions", str(folder), "--output", str(tmp_path / "all.pdf")]) == 2
