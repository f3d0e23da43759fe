"""Properties of a folder's disk that need no special rights: whether it is encrypted, whether two folders share one."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Literal

from carpus.core.model.installation import Finding
from carpus.core.model.phrase import phrase

EncryptionState = Literal["encrypted", "plain", "unknown"]

ENCRYPTED_FILE_SYSTEMS = ("ecryptfs", "fuse.gocryptfs", "fuse.cryfs", "fuse.encfs")
"""File systems that encrypt by themselves."""
TIMEOUT_S = 20.0
_BITLOCKER = (
    "(New-Object -ComObject Shell.Application).NameSpace('{drive}').Self"
    ".ExtendedProperty('System.Volume.BitLockerProtection')"
)
_ENCRYPTED_FLAG, _GET_FLAGS = 0x800, 0x80086601
"""Flag of an encrypted folder of ext4 and similar (fscrypt)."""


def detect_encryption(folder: Path) -> EncryptionState:
    """Return whether the disk of an existing or future folder is encrypted, as far as the system states it."""
    there = next((one for one in (folder, *folder.parents) if one.exists()), Path.cwd()).resolve()
    try:
        if sys.platform == "win32":
            return detect_bitlocker(there)
        return "encrypted" if _is_encrypted_folder(there) else detect_linux_encryption(there)
    except (OSError, ValueError, subprocess.SubprocessError):
        return "unknown"


def check_disk_encryption(state: EncryptionState) -> Finding:
    """Return the finding on disk encryption, for ``carpus doctor`` and the settings."""
    name = phrase("Disk encryption")
    if state == "encrypted":
        return Finding(name, "good", phrase("The disk of the data folder is encrypted by the system."))
    if state == "plain":
        return Finding(
            name, "warning", phrase("The disk of the data folder is not encrypted."), format_encryption_advice()
        )
    remedy = phrase("Ask your IT support. {how}", how=format_encryption_advice())
    return Finding(name, "warning", phrase("It is not known whether the disk of the data folder is encrypted."), remedy)


def format_encryption_advice(platform: str = sys.platform) -> str:
    """Return how to switch on the encryption of this system."""
    if platform == "win32":
        return phrase(
            "Turn it on in Windows: Settings → Privacy and security → Device encryption, or BitLocker in the "
            "Control Panel. Do not keep the recovery key with this computer."
        )
    return phrase(
        "Linux encrypts a disk when it is set up (LUKS). Choose this when the system is installed, or move the "
        "data folder to an encrypted disk. Do not keep the passphrase with this computer."
    )


def detect_linux_encryption(folder: Path, root: Path = Path("/")) -> EncryptionState:
    """Detect encryption by the mounted file system and the devices under it; LUKS may be under volumes.

    ``root`` is the root folder of the examined system. Raises OSError, ValueError.
    """
    number, kind, source = _find_mount(folder, (root / "proc/self/mountinfo").read_text(encoding="utf-8"))
    if kind in ENCRYPTED_FILE_SYSTEMS:
        return "encrypted"
    device = root / "sys/dev/block" / number
    if number.startswith("0:"):  # file systems of several devices, and such without one
        device = root / "sys/class/block" / (root / source.lstrip("/")).resolve().name
    return _detect_device_encryption(device.resolve()) if source.startswith("/dev/") else "unknown"


def detect_bitlocker(folder: Path) -> EncryptionState:
    """Detect BitLocker by its public state: 1 is on, 3 is being encrypted, 5 is on with an unprotected key.

    Raises OSError or SubprocessError.
    """
    command = ["powershell", "-NoProfile", "-Command", _BITLOCKER.format(drive=folder.drive)]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=TIMEOUT_S).stdout.strip()
    return "encrypted" if said == "1" else "plain" if said in ("2", "3", "4", "5") else "unknown"


def _find_mount(folder: Path, mounts: str) -> tuple[str, str, str]:
    """Return device number, file system and source of the mount that contains a folder."""
    found = ("0:0", "", "")
    longest = -1
    for line in mounts.splitlines():
        before, _, after = line.partition(" - ")
        number, place = before.split()[2], re.sub(r"\\(\d{3})", lambda code: chr(int(code[1], 8)), before.split()[4])
        if folder.is_relative_to(place) and len(place) >= longest:  # of two on one place the later one is seen
            longest, found = len(place), (number, after.split()[0], after.split()[1])
    return found


def _detect_device_encryption(device: Path) -> EncryptionState:
    """Return whether a device is encrypted, or all devices under it are."""
    if not device.is_dir() or (device / "loop").is_dir():
        return "unknown"
    uuid = device / "dm/uuid"
    if uuid.is_file() and uuid.read_text(encoding="utf-8").startswith("CRYPT-"):
        return "encrypted"
    under = [_detect_device_encryption(one.resolve()) for one in sorted((device / "slaves").glob("*"))]
    if "unknown" in under:
        return "unknown"
    return "encrypted" if under and "plain" not in under else "plain"


def _is_encrypted_folder(folder: Path) -> bool:
    import fcntl

    descriptor = os.open(folder, os.O_RDONLY)
    try:
        flags = fcntl.ioctl(descriptor, _GET_FLAGS, b"\0" * 8)
    except OSError:  # a file system without such flags
        return False
    finally:
        os.close(descriptor)
    return bool(int.from_bytes(flags[:4], sys.byteorder) & _ENCRYPTED_FLAG)


SYSTEM_DEVICES = Path("/sys/dev/block")


def is_same_disk(one: Path, other: Path, devices: Path = SYSTEM_DEVICES) -> bool:
    """Return whether two existing folders have a disk in common; False if one does not exist.

    Two partitions are on one disk, and so are encrypted or joined devices on top of it. On systems without a device
    table only folders of one file system are.
    """
    try:
        first, second = one.stat().st_dev, other.stat().st_dev
    except OSError:
        return False
    return first == second or bool(_find_disks(first, devices) & _find_disks(second, devices))


def _find_disks(device: int, devices: Path) -> set[str]:
    if not hasattr(os, "major"):  # Windows has no such table
        return set()
    found = devices / f"{os.major(device)}:{os.minor(device)}"
    return _physical_disks(found.resolve()) if found.exists() else set()


def _physical_disks(block: Path) -> set[str]:
    slaves = sorted((block / "slaves").glob("*"))
    if slaves:
        return {disk for slave in slaves for disk in _physical_disks(slave.resolve())}
    return {(block.parent if (block / "partition").exists() else block).name}
