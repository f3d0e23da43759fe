"""The validation's document: made by its command, with what a reviewer needs to make it again."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

from carpus.core.platform.provenance import source_revision
from tests.accuracy.jobs import jobs_for
from tests.accuracy.scenarios import WRIST
from tests.validation import MOTIONS, main, mountings

AGAIN = re.compile(r"make validation ARGUMENTS='([^']+)'")


def test_document_names_what_makes_it_again(tmp_path: Path) -> None:
    words = ["--people", "0", "--seeds", "1", "--only", "rest, no such row"]
    assert main([*words, "--output", str(tmp_path / "a.md")]) == 0
    made = (tmp_path / "a.md").read_text(encoding="utf-8")
    found = AGAIN.search(made)
    assert source_revision()[:12] in made
    assert main([*shlex.split(found[1]), *words[2:], "--output", str(tmp_path / "b.md")]) == 0
    assert (tmp_path / "b.md").read_text(encoding="utf-8") == made, "the same seeds, the same document"
    assert main([*words, "--output", str(tmp_path / "c.md")]) == 0
    assert (tmp_path / "c.md").read_text(encoding="utf-8") != made, "else fresh ones"


def test_seeds_are_of_nobody_else() -> None:
    made = [one.spec.seed for motion in MOTIONS for one in mountings(motion, 12, 10_000_000)]
    assert len(set(made)) == len(made)
    jobs = [job.seed for job in jobs_for(WRIST, 2, 0, 10_000_000)]
    assert min(jobs) >= 10_000_000
    assert not set(made) & set(jobs)


def test_person_keeps_what_new_mounting_does_not_change() -> None:
    first, second, other, _ = mountings("flexion", 2, 1)
    assert (first.spec.hand_length_mm, first.spec.range_share) == (second.spec.hand_length_mm, second.spec.range_share)
    assert first.spec.seed != second.spec.seed
    assert first.spec.hand_length_mm != other.spec.hand_length_mm
