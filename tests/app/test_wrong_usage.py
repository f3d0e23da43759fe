"""Every command with bad input of each kind: one line on stderr, no traceback, the right exit code.

A command that is new needs its lines in :data:`WRONG`; an option that is new is tried by itself.
"""

from __future__ import annotations

import argparse
import re
import shlex
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest

from carpus.app.__main__ import build_parser
from carpus.app.command_line import CommandParser
from carpus.app.commands import COMMANDS
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.records.database import STORE_FILE
from carpus.core.records.values import Patient
from tests.commands import Command
from tests.formats.takes import store_session
from tests.records.samples import open_store

WRONG: dict[str, list[tuple[str, int, str]]] = {
    "demo": [("--data-folder", 2, "--data-folder")],
    "review": [("", 2, "SESSION.h5"), ("{gone}.h5", 1, "gone.h5")],
    "track": [
        ("", 2, "--output"),
        ("{gone} --output {new}.h5", 1, "Recording not found"),
        ("{file} --output {new}.h5", 2, "--calibration"),
        ("{file} --calibration {gone} --output {new}.h5", 1, "{file}"),
        ("{empty} --output {new}", 1, "no recording in this folder"),
        ("{empty} --output {new}.h5", 1, "no recording in this folder"),
        ("{session} --output {session}", 1, "A file with this name already exists"),
        ("{file} --output {new}.h5 --profile slwo", 2, "did you mean “slow”? There are: slow, standard, brisk"),
        ("{file} --output {new}.h5 --exercise wrist_ff", 2, "did you mean “WRIST_F"),
        ("{file} --output {new}.h5 --calibraton x", 2, "did you mean “--calibration”"),
        ("{file} --output {new}.h5 --recorded yesterday", 2, "2023-04-05"),
        ("{gone}.h5 --output {new}.h5", 1, "gone.h5"),
        ("{session} --output {new}.h5 --subject A", 2, "leave out --subject"),
        ("{file} --output {new}.h5 --start-angles nan 0 0", 2, "--start-angles"),
        ("{file} --output {new}.h5 --subject ' '", 2, "pseudonym"),
        ("{file} --output {new}.h5 --jobs 2", 2, "many recordings"),
        ("{file} {session} --output {new}.h5", 2, "folder"),
        ("{file} {session} --output {new} --stream", 2, "one recording"),
        ("{gone} {empty} --output {new}", 1, "gone"),
    ],
    "record": [
        ("", 2, "--output"),
        ("--output {file}", 1, "A file with this name already exists"),
        ("--output {new} --from {gone}", 1, "Recording not found"),
        ("--output {new} --from {file}", 1, "{file}"),
        ("--output {new} --seconds nan", 2, "“nan” is no number from 0.1 to 86400"),
        ("--output {new}.csv", 2, "ends in .csv, and what is written is .carpusraw"),
        ("--output {new} --lossless --format tum", 2, "--lossless is for --format raw"),
        ("--output {new} --camera realsnse", 2, "did you mean “realsense”? There are: xtion, realsense, orbbec"),
    ],
    "simulate": [
        ("", 2, "--output"),
        ("--output {file}", 1, "{file}"),
        ("--output {new} --motion flexon", 2, "did you mean “flexion”"),
        ("--output {new} --skin-glide-mm much", 2, "“much” is no number, and not “drawn”"),
        ("--output {new} --fps inf", 1, "fps"),
    ],
    "info": [("", 2, "FILE"), ("{gone}", 1, "{gone}"), ("{junk}", 1, "{junk}"), ("{empty}", 1, "{empty}")],
    "verify": [("", 2, "FILE"), ("{gone}", 1, "{gone}"), ("{junk}", 1, "{junk}"), ("{empty}", 1, "{empty}")],
    "report": [
        ("{session}", 2, "--output"),
        ("{gone} --output {new}.pdf", 1, "gone"),
        ("{junk} --output {new}.pdf", 1, "{junk}"),
        ("{session} --output {file}", 1, "A file with this name already exists"),
        ("{session} --output {new}.csv", 2, "ends in .csv, and what is written is .pdf"),
        ("{session} --output {gone}/a.pdf", 1, "{gone}"),
        ("{session} --output {new}.pdf --language fr", 2, "There are: en, de, it|there are: en, de, it"),
    ],
    "progress": [
        ("", 2, "PSEUDONYM"),
        (
            "Lindn --sessions {session}",
            1,
            "There is no patient called Lindn (did you mean “Linden 42”? There are: Linden 42)",
        ),
        ("nobody", 1, "There is no patient called nobody (there are: Fern 12)"),
        ("nobody --sessions {empty}", 1, "There is no session in {empty}"),
        ("'fern 12'", 1, "There is no session in {data}"),
        ("all --sessions {empty}", 1, "There is no session in {empty}"),
        ("all --output {new}.pdf", 2, "one patient"),
        ("all --sessions {session} --output {file}", 1, "A file with this name already exists"),
    ],
    "export": [
        ("{session}", 2, "--output"),
        ("{session} --format cvs --output {new}", 2, "did you mean “csv”"),
        ("{gone} --output {new}", 1, "gone"),
        ("{junk} --output {new}", 1, "{junk}"),
        ("{empty} --output {new}", 1, "There is no session in {empty}"),
        ("{session} --output {file}", 1, "{file}"),
    ],
    "compare": [
        ("{session}", 2, "a session and its reference"),
        ("--study {gone}", 1, "gone"),
        ("{session} {session} --drift 50", 2, "“50” is no number from -10 to 10 percent"),
        ("{loop} {session}", 1, "{loop}"),
        ("{session} {junk}", 1, "{junk}"),
        ("{session} {session} --markers WRST=a", 2, "did you mean “WRIST”"),
    ],
    "retest": [
        ("", 2, "SESSION.h5"),
        ("{gone}", 1, "There is no folder {gone}"),
        ("{empty}", 1, "There is no session in {empty}"),
        ("{session} --raters {gone}", 1, "No such file"),
    ],
    "results": [
        ("", 2, "SESSION.h5"),
        ("{gone}", 1, "There is no folder {gone}"),
        ("{empty}", 1, "There is no session in {empty}"),
        ("{junk}", 1, "{junk}"),
        ("{session} --output {new}.pdf", 2, "ends in .pdf, and what is written is .csv or .parquet"),
    ],
    "log": [
        ("--data-folder {gone}", 1, "There is no folder {gone}"),
        ("--data-folder {data} --output {gone}/log.csv", 1, "gone"),
    ],
    "erase": [
        ("", 2, "PSEUDONYM"),
        ("{session}", 1, "lies in no data folder"),
        ("{gone}.h5", 1, "gone.h5"),
        ("'Fern 21'", 1, "There is no patient called Fern 21 (did you mean “Fern 12”? There are: Fern 12)"),
        ("'Fern 12' --data-folder {gone}", 1, "There is no folder {gone}"),
    ],
    "backup": [
        ("", 2, "FOLDER"),
        ("{empty} --list", 1, "There is no backup in {empty}"),
        ("{empty} --data-folder {gone}", 1, "{gone}"),
        ("{loop}", 1, "cannot write to {loop}"),
    ],
    "restore": [
        ("", 2, "FOLDER"),
        ("{empty}", 2, "--into FOLDER"),
        ("{empty} --into {new}", 1, "There is no backup in {empty}"),
    ],
    "recover": [("", 2, "FOLDER"), ("{gone}", 1, "There is no folder {gone}"), ("{file}", 1, "There is no folder")],
    "calibrate-camera": [
        ("{gone}", 1, "Recording not found"),
        ("--board {file}", 1, "A file with this name already exists"),
        ("{file} --board {new}.pdf", 2, "--board only prints"),
        ("--square-mm 2", 2, "“2” is no number from 5 to 200 mm"),
    ],
    "check-card": [
        ("{gone}", 1, "Recording not found"),
        ("--card {file}", 1, "A file with this name already exists"),
        ("{file} --card {new}.pdf", 2, "--card only prints"),
        ("--card {new}.pdf --paper a5", 2, "there are: a4, letter"),
    ],
    "doctor": [("--camera foo", 2, "no kind of camera is called “foo”; there are: xtion, realsense, orbbec")],
}
"""Of each command the words after it, the exit code, and what stderr says (one of several, by |)."""

ROWS = [(name, *row) for name, rows in WRONG.items() for row in rows]


@pytest.fixture(scope="module")
def places(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """What stands in braces in :data:`WRONG`, made once, since nothing of it may be changed; the data folder has one
    patient and no session."""
    root = tmp_path_factory.mktemp("places")
    names = {name: root / name for name in ("gone", "new", "empty", "file", "loop", "data")} | {
        "junk": root / "junk.h5"
    }
    names["empty"].mkdir()
    names["loop"].symlink_to(names["loop"])
    for name in ("file", "junk"):
        names[name].write_bytes(b"neither this nor that")
    with open_store(names["data"]) as house:
        house.patients.add(Patient("Fern 12", "right"))
    return names | {"session": store_session(tmp_path_factory.mktemp("session"), frames=30, moving=True)}


@pytest.fixture
def data(places: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CARPUS_DATA", str(places["data"]))


def command_parser(name: str) -> CommandParser:
    top = build_parser([name])
    (chosen,) = (action for action in top._actions if isinstance(action, argparse._SubParsersAction))
    sub = chosen.choices[name]
    assert isinstance(sub, CommandParser)
    return sub


def options(name: str) -> Iterator[argparse.Action]:
    yield from (one for one in command_parser(name)._actions if not isinstance(one, argparse._HelpAction))


def test_wrong_usage_covers_every_command() -> None:
    assert set(WRONG) == set(COMMANDS)


@pytest.mark.usefixtures("data")
@pytest.mark.parametrize(("name", "words", "code", "said"), ROWS, ids=[f"{row[0]} {row[1]}" for row in ROWS])
def test_wrong_input_is_told_in_one_line(
    name: str, words: str, code: int, said: str, places: dict[str, Path], command: Command
) -> None:
    done = command(name, *shlex.split(words.format(**places)))
    assert done.code == code
    assert done.err.startswith("carpus")
    assert (done.err.count("\n"), done.err[-1]) == (1, "\n")
    assert any(each in done.err for each in said.format(**places).split("|")), done.err
    assert not re.search(r"Traceback|unforeseen|usage:|[a-z]+_[a-z]+ value", done.err)
    assert "Written" not in done.out
    if places["new"].is_dir():
        places["new"].rmdir()  # of an export: with nothing in it
    assert not list(places["new"].parent.glob("new*")), "nothing is made"


@pytest.mark.parametrize("name", COMMANDS)
def test_options_refuse_unreadable_values(name: str, command: Command) -> None:
    """A value that no option of its kind can have, given to each; with what else it needs left out."""
    for option in options(name):
        if not option.option_strings or option.nargs == 0 or (option.type in (None, Path) and not option.choices):
            continue
        values = ["no such\nthing.exe"] * (option.nargs if isinstance(option.nargs, int) else 1)
        done = command(name, option.option_strings[0], *values)
        assert (done.code, done.err.count("\n")) == (2, 1), option.dest
        assert done.err.startswith(f"carpus {name}: {option.option_strings[0]}"), done.err
        assert "invalid" not in done.err
    unknown = command(name, "--no-such-option")
    assert (unknown.code, unknown.err.count("\n")) == (2, 1)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_shows_examples_that_can_be_typed(name: str, command: Command) -> None:
    told = command(name, "--help")
    assert told.code == 0
    examples = told.out.partition("Example:\n")[2].splitlines()
    assert examples
    for line in examples:
        program, *words = shlex.split(line)
        assert (program, words[0]) == ("carpus", name)
        build_parser(words).parse_args(words)
    if name == "track":
        assert all(exercise.id in told.out for exercise in EXERCISES)


def test_commands_of_the_readme_can_be_typed() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    lines = re.findall(r"^\.venv/bin/(carpus .+)$|`\.venv/bin/(carpus[^`]*)`", readme, re.MULTILINE)
    assert len(lines) >= 6
    for line in lines:
        words = shlex.split("".join(line))[1:]
        build_parser(words).parse_args(words)


def test_unknown_command_is_reported_with_what_was_meant(command: Command) -> None:
    done = command("trak", "recording")
    assert (done.code, done.err.count("\n")) == (2, 1)
    assert "Unknown command “trak”. Did you mean “track”?" in done.err
    assert all(name in command("qwertz").err for name in COMMANDS)


@pytest.mark.usefixtures("data")
def test_list_of_patients_that_another_program_holds_is_left_where_it_is(
    places: dict[str, Path], command: Command
) -> None:
    holding = sqlite3.connect(places["data"] / STORE_FILE, isolation_level=None)
    holding.execute("PRAGMA locking_mode = EXCLUSIVE")
    holding.execute("BEGIN EXCLUSIVE")
    holding.execute("UPDATE patient SET note = ''")
    try:
        done = command("erase", "Fern 12")
    finally:
        holding.close()
    assert (done.code, done.err.count("\n")) == (1, 1)
    assert "Close the other window" in done.err
    assert "move" not in done.err
