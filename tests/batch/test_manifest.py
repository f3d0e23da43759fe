"""``carpus track --manifest``: the list of a study is checked whole, and its columns go into the table."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from carpus.app.commands.track_many import read_manifest
from carpus.core.session.reader import read_session
from tests.commands import Command
from tests.rendered import DEVIATION, FLEXION, REPEATED_FLEXION, Rendered


@pytest.fixture(scope="module")
def recordings(rendered: Rendered, tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("study")
    for name, spec in (("first", DEVIATION), ("second", FLEXION)):
        (root / name).symlink_to(rendered(spec))
    return root


def write_list(folder: Path, *lines: str) -> Path:
    path = folder / "study.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_manifest_faults_are_told_together_and_nothing_is_tracked(
    recordings: Path, tmp_path: Path, command: Command
) -> None:
    study = write_list(
        recordings,
        "recording,subject,hand,exercise,label,mean",
        "gone,P-1,,WRIST_FE,a,1",
        "first,P-1,left,WRIST_FF,b,2",
        "first,P-1,,,c,3",
        "second,P-2,,,C,4",
        "second,P-2,,,../d,5",
    )
    done = command("track", "--manifest", study, "--output", tmp_path / "out")
    assert done.code == 2
    for said in (
        "column “mean” is one of the results",
        "line 2: recording not found",
        "line 3: hand is “left”, and the clicks are of the right one",
        "line 3: Unknown exercise “WRIST_FF”; did you mean “WRIST_FE”",
        "line 5: “C” occurs twice",
        "line 6: the label “../d” is not the name of a file",
        "6 faults in the list; nothing was tracked",
    ):
        assert said in done.err
    assert not (tmp_path / "out").exists()


def test_manifest_without_column_of_recordings_is_told(recordings: Path, tmp_path: Path) -> None:
    assert read_manifest(write_list(recordings, "file,subject", "first,P-1"), tmp_path).problems == (
        "there is no column “recording”",
    )


def test_manifest_gives_each_recording_its_subject_exercise_and_columns(
    recordings: Path, tmp_path: Path, command: Command
) -> None:
    study = write_list(
        recordings,
        "recording;subject;exercise;label;clinic;week",
        "first;P-1;;one;north;1",
        "second;P-2;WRIST_RU;two;=south;2",
    )
    out = tmp_path / "out"
    done = command("track", "--manifest", study, "--output", out, "--no-smooth")
    assert done.code == 0, done.err
    headers = {path.stem: read_session(path).header for path in out.glob("*.h5")}
    assert {name: (one.subject_id, one.exercise) for name, one in headers.items()} == {
        "one": ("P-1", "WRIST_RU"),  # that of the clicks
        "two": ("P-2", "WRIST_RU"),
    }
    with (out / "measures.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {(row["subject_id"], row["clinic"], row["week"]) for row in rows} == {
        ("P-1", "north", "1"), ("P-2", "'=south", "2"),
    }  # fmt: skip
    assert "no repetition of WRIST_RU is counted" in done.out

    changed = study.read_text(encoding="utf-8").replace("P-1", "P-3")
    study.write_text(changed, encoding="utf-8")
    again = command("track", "--manifest", study, "--output", out, "--no-smooth")
    assert again.out.count("tracked before of another patient or exercise") == 1

    table = command("results", out)
    assert [line.split()[:2] for line in table.out.splitlines()[1:]] == [["two", "P-2"], ["one", "P-1"]] or [
        line.split()[:2] for line in table.out.splitlines()[1:]
    ] == [["one", "P-1"], ["two", "P-2"]]
    listed = json.loads(command("results", out, "--json").out)
    assert {row["subject_id"] for row in listed} == {"P-1", "P-2"}
    written = command("results", out, "--output", tmp_path / "study.csv")
    assert written.code == 0
    with (tmp_path / "study.csv").open(newline="", encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == len(listed)


def test_clicks_and_exercise_beside_recording_are_taken(rendered: Rendered, tmp_path: Path, command: Command) -> None:
    folder = rendered(REPEATED_FLEXION)
    done = command("track", folder, "--output", tmp_path / "s.h5", "--no-smooth")
    assert done.code == 0, done.err
    assert read_session(tmp_path / "s.h5").header.exercise == "WRIST_FE"
    assert "repetition" in done.out


def test_other_exercise_than_hand_did_is_told(rendered: Rendered, tmp_path: Path, command: Command) -> None:
    folder = rendered(REPEATED_FLEXION)
    done = command("track", folder, "--exercise", "WRIST_RU", "--output", tmp_path / "s.h5", "--no-smooth")
    assert done.code == 0
    assert "in flexion and" in done.err
    assert "track again with --exercise WRIST_FE" in done.err


def test_unknown_exercise_is_told_with_why_it_matters(rendered: Rendered, tmp_path: Path, command: Command) -> None:
    folder = rendered(FLEXION)
    clicks = json.loads((folder / "calibration.json").read_text(encoding="utf-8"))
    del clicks["exercise"]
    (tmp_path / "clicks.json").write_text(json.dumps(clicks), encoding="utf-8")
    done = command("track", folder, "--calibration", tmp_path / "clicks.json", "--output", tmp_path / "s.h5")
    assert "repetitions, speed and smoothness are not measured; --exercise names it" in done.err
