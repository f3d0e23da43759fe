"""Whether two folders go with the same disk."""

from __future__ import annotations

import os
from pathlib import Path

SYSTEM_DEVICES = Path("/sys/dev/block")


def on_same_disk(one: Path, other: Path, devices: Path = SYSTEM_DEVICES) -> bool:
    """Whether the disks below two folders that are there have one in common; False where one of them is not there.

    Two partitions lie on one disk, and so does what is encrypted or joined on top of it. Where the system says nothing
    of its disks, two folders of one file system do.
    """
    try:
        first, second = one.stat().st_dev, other.stat().st_dev
    except OSError:
        return False
    return first == second or bool(_disks(first, devices) & _disks(second, devices))


def _disks(device: int, devices: Path) -> set[str]:
    if not hasattr(os, "major"):  # Windows has no such table
        return set()
    found = devices / f"{os.major(device)}:{os.minor(device)}"
    return _below(found.resolve()) if found.exists() else set()


def _below(block: Path) -> set[str]:
    """The disks that a block device is made of."""
    slaves = sorted((block / "slaves").glob("*"))
    if slaves:
        return {disk for slave in slaves for disk in _below(slave.resolve())}
    return {(block.parent if (block / "partition").exists() else block).name}
