"""The page of the validation: made by its command, with what a reviewer needs to make it again."""

from __future__ import annotations

from pathlib import Path

import pytest

from carpus.core.model.hand.exercises import EXERCISES
from tests import validation
from tests.validation import MOUNTINGS, Job, main


def test_page_names_what_makes_it_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(validation, "SECONDS", 5.0)
    asked = "--first-seed 10000001 --people 2 --exercises WRIST_FE"
    less = ["--second", "0", "--no-images", "--processes", "1"]
    assert main([*asked.split(), *less, "--output", str(tmp_path / "page.md")]) == 0
    made = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert "simulated" in made.splitlines()[0]
    assert made.count("| WRIST_FE | flexion") == 4, "agreement, and the retest of arc and both ends"
    assert f"make validation ARGUMENTS='{asked}'" in made


def test_seeds_belong_to_one_recording_each() -> None:
    jobs = [Job(exercise.id, 20, (), 10_000_000) for exercise in EXERCISES]
    made = [job.spec(person, k).seed for job in jobs for person in range(20) for k in range(MOUNTINGS)]
    assert len(set(made)) == len(made)
    assert min(made) >= 10_000_000


def test_new_mounting_keeps_the_person() -> None:
    job = Job("WRIST_FE", 2, (), 1)
    first, second, other = job.spec(0, 0), job.spec(0, 1), job.spec(1, 0)
    assert (first.hand_length_mm, first.range_share) == (second.hand_length_mm, second.range_share)
    assert first.seed != second.seed
    assert first.hand_length_mm != other.hand_length_mm
