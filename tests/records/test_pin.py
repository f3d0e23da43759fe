"""The PIN: kept as a hash, counted, paused, and never opened by a damaged file."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from functools import partial
from pathlib import Path

import argon2
import pytest

from carpus.core.records.pin import PIN_FILE, Pin

NOW = datetime(2026, 11, 20, 9, 0, tzinfo=UTC)


@pytest.fixture
def pin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Pin:
    """One whose hash is made in no time."""
    monkeypatch.setattr(argon2, "PasswordHasher", partial(argon2.PasswordHasher, 1, 8, 1))
    pin = Pin(tmp_path)
    assert not pin.is_set
    pin.set("4821")
    return pin


def test_pin_set_stores_hash_only(tmp_path: Path) -> None:
    pin = Pin(tmp_path)
    pin.set("4821")
    content = (tmp_path / PIN_FILE).read_text()
    assert "4821" not in content
    assert "$argon2id$v=19$m=65536,t=3," in content, "guessing takes long"
    assert (tmp_path / PIN_FILE).stat().st_mode & 0o777 == 0o600
    assert pin.check("4821", NOW).is_correct


def test_pin_check_wrong_tries_lead_to_pause(pin: Pin, tmp_path: Path) -> None:
    said = [Pin(tmp_path).check("0000", NOW) for _ in range(5)]  # each as after a start
    assert [one.tries_left for one in said] == [4, 3, 2, 1, 0]
    assert not any(one.is_correct for one in said)
    assert said[-1].pause_s == 60.0
    paused = pin.check("4821", NOW + timedelta(seconds=20))
    assert (paused.is_correct, paused.pause_s) == (False, 40.0)
    assert pin.check("0000", NOW + timedelta(seconds=60)).tries_left == 4, "after it as many as before"
    assert pin.check("4821", NOW + timedelta(seconds=60)).is_correct
    for _ in range(5):
        pin.check("0000", NOW + timedelta(seconds=61))
    assert pin.check("4821", NOW - timedelta(hours=5)).is_correct, "a clock set back locks nobody out for ever"
    assert pin.check("0000", NOW + timedelta(seconds=61)).tries_left == 4, "the right one forgives"


def test_pin_check_damaged_file_stays_locked(pin: Pin, tmp_path: Path) -> None:
    for content in ("", "{}", '{"pin": "", "refused": 0, "since": ""}', '{"pin": 3}', "[" * 5000):
        (tmp_path / PIN_FILE).write_text(content)
        assert pin.is_set
        assert not pin.check("4821", NOW).is_correct
        assert not pin.check("", NOW).is_correct
