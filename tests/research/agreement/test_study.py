"""Many people and sessions in one study: figures of all, of each, one table, one picture; what is wrong is told."""

from __future__ import annotations

import csv
import json
import math
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.research.agreement.agreement_files import compare_files
from carpus.core.research.agreement.compare import AnglePairs
from carpus.core.research.agreement.statistics import Agreement, VarianceComponents
from carpus.core.research.agreement.study import PooledAngle, _pooling_remarks
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_session
from tests.commands import Command
from tests.formats.takes import store_session

OFFSETS = {"anna": (2.0, 2.4), "bert": (-1.0, -0.6), "cleo": (0.5, 0.7), "dora": (3.0,)}
"""How far each person's references lie off, degrees."""


def reference(path: Path, session: Path, off_deg: float, sign: float = 1.0) -> Path:
    read = read_session(session)
    flexion = np.degrees(read.motion.angles_rad[:, 1])
    noise = np.random.default_rng(abs(round(100 * off_deg))).normal(0.0, 0.3, len(flexion))
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(("time_s", "bend"))
        table.writerows(zip(read.timestamp_s, sign * flexion - off_deg + noise, strict=True))
    return path


def write_table(path: Path, rows: Iterable[tuple[str, str, str]]) -> Path:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(("person", "session", "reference", "columns", "lag_s"))
        table.writerows((*row, "flexion=bend", "0") for row in rows)
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("study")
    session = store_session(root, frames=300, moving=True)
    rows = []
    for person, offsets in OFFSETS.items():
        for number, off_deg in enumerate(offsets):
            name = f"{person}-{number}"
            shutil.copy(session, root / f"{name}.h5")
            reference(root / f"{name}.csv", session, off_deg)
            rows.append((person, f"{name}.h5", f"{name}.csv"))
    write_table(root / "all.csv", rows)
    return root


def test_study_passes_shift_and_choices_to_every_session(
    folder: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[dict[str, Any]] = []

    def compared(*paths: Path, **how: Any) -> Any:
        asked.append(how)
        return compare_files(*paths, **how)

    left_out = RepetitionChoices({0: "pain"})
    monkeypatch.setattr("carpus.core.research.agreement.study.compare_files", compared)
    monkeypatch.setattr("carpus.app.session_commands.read_choices", lambda _: left_out)
    assert command("compare", "--study", folder / "all.csv", "--max-shift", "0.5").code == 0
    assert len(asked) == 7
    assert all(how["max_shift_s"] == 0.5 and how["choices"] is left_out for how in asked)


def test_study_weights_people_alike_in_one_table(folder: Path, tmp_path: Path, command: Command) -> None:
    out = tmp_path / "out"
    done = command("compare", "--study", folder / "all.csv", "--output", out)
    assert done.code == 0
    assert "4 people, 7 sessions" in done.out
    assert "sd between people" in done.out
    assert {path.name for path in out.iterdir()} == {"all.study.csv", "all.study.json", "all.flexion.png", "all.pdf"}
    with (out / "all.study.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    everybody, *each = rows
    assert everybody["of"] == "all people"
    assert [row["person"] for row in each] == [person for person, offsets in OFFSETS.items() for _ in offsets]
    means = np.array([np.mean(offsets) for offsets in OFFSETS.values()])
    assert float(everybody["bias_deg"]) == pytest.approx(means.mean(), abs=0.05)
    assert float(everybody["sd_between_people_deg"]) == pytest.approx(means.std(ddof=1), rel=0.05)
    # Four people: Student's t with three degrees of freedom, not the intervals of 2100 pictures.
    half = 3.182 * means.std(ddof=1) / 2.0
    assert float(everybody["bias_high_deg"]) - float(everybody["bias_deg"]) == pytest.approx(half, rel=0.05)
    assert everybody["icc_2_1"] == "", "pairs of several people have no ICC in common"
    said_by_json = json.loads((out / "all.study.json").read_text(encoding="utf-8"))
    assert len(said_by_json["sessions"]) == 7
    assert all(len(one["reference_sha256"]) == 64 for one in said_by_json["sessions"])


def test_study_excludes_incomparable_rows_with_reason(folder: Path, tmp_path: Path, command: Command) -> None:
    turned = reference(folder / "turned.csv", folder / "anna-0.h5", 0.0, sign=-1.0)
    rows = [
        ("anna", "anna-0.h5", turned.name), ("bert", "bert-0.h5", "bert-0.csv"), ("cleo", "none.h5", "cleo-0.csv"),
    ]  # fmt: skip
    table = write_table(folder / "some.csv", rows)
    done = command("compare", "--study", table, "--output", tmp_path / "out")
    assert done.code == 1
    assert all(words in done.out for words in ("none.h5", "opposite sign", "too few"))
    with (tmp_path / "out" / "some.study.csv").open(newline="", encoding="utf-8") as file:
        found = {(row["of"], row["person"]): row for row in csv.DictReader(file)}
    assert "opposite sign" in found["session", "anna"]["remarks"]
    assert found["left out", "cleo"]["remarks"]
    assert found["all people", ""]["bias_deg"] == ""


_HEAD = "person,session,reference,drift_percent,lag_s\n"


def test_study_table_invalid_is_refused(tmp_path: Path, command: Command) -> None:
    for text in (
        "", "person,session\n1,2\n", "person,session,reference\n,a.h5,b.csv\n", "\x00\x01",
        f"{_HEAD}a,a.h5,b.csv,400,\n", f"{_HEAD}a,a.h5,b.csv,,nan\n",
    ):  # fmt: skip
        (tmp_path / "t.csv").write_text(text)
        done = command("compare", "--study", tmp_path / "t.csv")
        assert (done.code, "t.csv" in done.err) == (1, True), text
    assert command("compare").code == 2
    assert command("compare", "--study", tmp_path / "t.csv", "--lag", "1").code == 2


def test_study_names_people_outside_the_pooled_values() -> None:
    nothing = AnglePairs("flexion", np.zeros(0), np.zeros(0), np.zeros(0), Agreement(0))
    few = PooledAngle(nothing, VarianceComponents(2, math.nan, math.nan), 3, ("anna", "bert"), 3)
    assert "anna, bert" in _pooling_remarks(few)[0]
    assert "too few" in _pooling_remarks(few)[1]
