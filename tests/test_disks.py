"""Whether a disk is encrypted and whether two folders lie on one disk, of systems that are files here."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest

from carpus.core.platform.disks import (
    check_disk_encryption,
    detect_bitlocker,
    detect_encryption,
    detect_linux_encryption,
    format_encryption_advice,
    is_same_disk,
)

HOME = Path("/home/ada/Carpus data")


class System:
    """A root with mounts and devices."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for folder in ("proc/self", "sys/dev/block", "sys/class/block", "sys/devices", "dev/mapper"):
            (root / folder).mkdir(parents=True)
        self.mounts: list[str] = []

    def device(self, name: str, number: str, *, uuid: str = "", on: Sequence[str] = ()) -> None:
        device = self.root / "sys/devices" / name
        (device / "slaves").mkdir(parents=True)
        if uuid:
            (device / "dm").mkdir()
            (device / "dm/uuid").write_text(f"{uuid}\n")
        for under in on:
            (device / "slaves" / under).symlink_to(self.root / "sys/devices" / under)
        (self.root / "sys/dev/block" / number).symlink_to(device)
        (self.root / "sys/class/block" / name).symlink_to(device)
        (self.root / "dev" / name).touch()

    def mount(self, number: str, place: str, kind: str, source: str) -> None:
        self.mounts.append(f"{30 + len(self.mounts)} 1 {number} / {place} rw shared:1 - {kind} {source} rw")
        (self.root / "proc/self/mountinfo").write_text("\n".join(self.mounts) + "\n")

    def state(self, folder: Path = HOME) -> str:
        return detect_linux_encryption(folder, self.root)


@pytest.fixture
def system(tmp_path: Path) -> System:
    made = System(tmp_path)
    made.device("sda1", "8:1")
    made.device("sda2", "8:2")
    made.mount("8:1", "/", "ext4", "/dev/sda1")
    return made


def test_linux_encryption_plain_and_luks_partition(system: System) -> None:
    assert system.state() == "plain"
    system.device("dm-0", "254:0", uuid="CRYPT-LUKS2-0c2f-home", on=["sda2"])
    system.mount("254:0", "/home", "ext4", "/dev/mapper/home")
    assert system.state() == "encrypted"
    assert system.state(Path("/srv/data")) == "plain", "another mount"


def test_linux_encryption_volume_needs_all_devices(system: System) -> None:
    system.device("dm-0", "254:0", uuid="CRYPT-LUKS2-0c2f-all", on=["sda2"])
    system.device("dm-1", "254:1", uuid="LVM-abcdef", on=["dm-0"])
    system.mount("254:1", "/home", "xfs", "/dev/mapper/vg-home")
    assert system.state() == "encrypted"
    system.device("dm-2", "254:2", uuid="LVM-ghijkl", on=["dm-0", "sda1"])
    system.mount("254:2", "/home/ada", "xfs", "/dev/mapper/vg-ada")
    assert system.state() == "plain", "half of it lies on a plain disk"


def test_linux_encryption_network_mount_is_unknown(system: System) -> None:
    for kind, source in (("overlay", "overlay"), ("nfs4", "server:/share"), ("cifs", "//server/share"), ("zfs", "p/x")):
        system.mount("0:44", "/home", kind, source)
        assert system.state() == "unknown", kind


def test_encryption_of_bitlocker(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = {"1\r\n": "encrypted", "2\n": "plain", "3\n": "plain", "6\n": "unknown", "": "unknown"}
    for said, state in answers.items():
        monkeypatch.setattr(subprocess, "run", lambda *_, said=said, **__: SimpleNamespace(stdout=said))
        assert detect_bitlocker(Path("C:/data")) == state


def test_detect_encryption_on_this_computer_raises_nothing(tmp_path: Path) -> None:
    assert detect_encryption(tmp_path / "not there yet") in ("encrypted", "plain", "unknown")


def test_check_disk_encryption_only_encrypted_is_good() -> None:
    assert check_disk_encryption("encrypted").state == "good"
    for state in ("plain", "unknown"):
        finding = check_disk_encryption(state)  # type: ignore[arg-type]
        assert finding.state == "warning"
        assert format_encryption_advice() in finding.remedy
    assert "BitLocker" in format_encryption_advice("win32")
    assert "LUKS" in format_encryption_advice("linux")


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


def test_is_same_disk_of_partitions_and_volumes(devices: Path) -> None:
    first, second, encrypted, other, unknown = folder(8, 1), folder(8, 2), folder(253, 0), folder(8, 17), folder(0, 40)
    assert is_same_disk(first, second, devices)
    assert is_same_disk(first, encrypted, devices)
    assert not is_same_disk(first, other, devices)
    assert not is_same_disk(encrypted, other, devices)
    assert not is_same_disk(first, unknown, devices)
    assert is_same_disk(unknown, unknown, devices)
