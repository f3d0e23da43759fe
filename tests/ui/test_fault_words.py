"""What the cards say of files has room on a card."""

from __future__ import annotations

import pytest

from carpus.core.errors import DiskFull
from carpus.ui.fault_words import fault_words, shortened


@pytest.mark.parametrize("root", ["/home/someone/.local/share/carpus", "C:\\Users\\Some One\\AppData\\carpus"])
def test_a_long_path_is_told_by_its_end(root: str) -> None:
    stroke = "\\" if "\\" in root else "/"
    name = "Blue-Hummingbird-Mountain-42_2026-11-21_154533_WRIST_FE_right.h5"
    words = fault_words(DiskFull(stroke.join((root, "sessions", "Blue-Hummingbird-Mountain-42", name)), "full"))
    assert max(len(part) for part in words.happened.split("/")) < 48
    assert "someone" not in words.happened
    assert "right.h5" in words.happened


def test_what_is_no_path_stays() -> None:
    assert "take 7" in fault_words(DiskFull("take 7", "1/2 full")).happened
    assert "1/2 full" in fault_words(DiskFull("take 7", "1/2 full")).happened


@pytest.mark.parametrize("most", [8, 9, 30])
def test_a_shortened_name_keeps_both_ends(most: int) -> None:
    name = "abcdefghijklmnopqrstuvwxyz0123456789"
    short = shortened(name, most)
    assert len(short) == most
    assert short[0] == "a"
    assert short[-1] == "9"
    assert shortened("short", most) == "short"
