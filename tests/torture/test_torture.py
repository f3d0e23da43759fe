"""The short form of ``make torture``; the long one prints its figures."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.torture import backup_kills, kills, mutations, store_kills, two_programs, write_kills
from tests.torture.__main__ import MOST_BYTES, mutation_line, read_mutations, start_line

FILES = {"session": 8, "part": 8, "register": 8}


@pytest.mark.parametrize("kind", ["program with pictures", "capture"])
def test_kill_loses_second_at_most(tmp_path: Path, kind: str) -> None:
    """That of looking back is ``tests/app/test_measuring``'s."""
    done = kills.kill_once(kind, 1, tmp_path / "killed")
    assert done.lost_s <= kills.MOST_LOST_S


def test_kill_at_any_write_of_a_recording_or_recovery_keeps_what_was_synchronised(tmp_path: Path) -> None:
    assert len(write_kills.lines(251, 3, tmp_path)) == len(write_kills.KINDS) + 1


@pytest.mark.parametrize("kind", backup_kills.KINDS)
def test_killed_backup_or_restore_leaves_nothing_half(tmp_path: Path, kind: str) -> None:
    assert backup_kills.line(kind, 3, tmp_path / "kills")


@pytest.mark.parametrize("kind", store_kills.KINDS)
def test_killed_change_of_store_is_there_whole_or_not_at_all(tmp_path: Path, kind: str) -> None:
    assert store_kills.line(kind, 1, tmp_path / "kills")


@pytest.mark.parametrize("kind", [kind for kind in mutations.KINDS if kind not in ("oni", "raw")])
def test_damaged_files_are_told(tmp_path: Path, kind: str) -> None:
    """No traceback, no reader that dies or stays, no gigabyte; times are measured where nothing else runs. Recordings
    of one file are damaged hundreds of times in ``tests/capture``."""
    outcomes = read_mutations(kind, FILES.get(kind, 12), tmp_path)
    assert [one for one in outcomes if not one.good or one.memory_bytes > MOST_BYTES] == []
    assert kind == "journal" or any(one.said != "read" for one in outcomes), mutation_line(kind, outcomes)


def test_program_starts_with_all_of_them_in_its_folder(tmp_path: Path) -> None:
    assert "set apart" in start_line(2, tmp_path)


def test_torture_two_programs_on_failing_server(tmp_path: Path) -> None:
    assert two_programs.line(40, 2.0, 0.4, tmp_path / "clinic")
