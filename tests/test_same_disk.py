"""Two folders lie on one disk also through partitions, encryption and joined disks."""

from __future__ import annotations

import os
from pathlib import Path
from types import SimpleNamespace

import pytest

from carpus.core import disks
from carpus.core.disks import on_same_disk


@pytest.fixture
def devices(tmp_path: Path) -> Path:
    """``sda`` with two partitions, the second under encryption (253:0), and ``sdb`` with one."""
    table, blocks = tmp_path / "dev", tmp_path / "block"
    table.mkdir()
    for number, name in {"8:1": "sda/sda1", "8:2": "sda/sda2", "8:17": "sdb/sdb1", "253:0": "dm-0"}.items():
        block = blocks / name
        block.mkdir(parents=True)
        if "/" in name:
            (block / "partition").write_text("1")
        (table / number).symlink_to(block)
    (blocks / "dm-0" / "slaves").mkdir()
    (blocks / "dm-0" / "slaves" / "sda2").symlink_to(blocks / "sda/sda2")
    return table


def folder(major: int, minor: int) -> Path:
    return SimpleNamespace(stat=lambda: SimpleNamespace(st_dev=os.makedev(major, minor)))  # type: ignore[return-value]


def test_partitions_and_what_lies_on_them_are_one_disk(devices: Path) -> None:
    first, second, encrypted, other, unknown = folder(8, 1), folder(8, 2), folder(253, 0), folder(8, 17), folder(0, 40)
    assert on_same_disk(first, second, devices)
    assert on_same_disk(first, encrypted, devices)
    assert not on_same_disk(first, other, devices)
    assert not on_same_disk(encrypted, other, devices)
    assert not on_same_disk(first, unknown, devices)
    assert on_same_disk(unknown, unknown, devices)


def test_without_a_table_of_disks_the_file_system_decides(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(disks, "os", SimpleNamespace())
    (tmp_path / "a").mkdir()
    assert on_same_disk(tmp_path, tmp_path / "a")
    assert not on_same_disk(tmp_path, tmp_path / "not there")
