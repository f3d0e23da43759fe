"""What leaves the computer as one file with a passphrase: a tar in the age format, by a library that is kept for it.

``age --decrypt FILE | tar --extract`` opens it without Carpus. It is made and opened in memory, three times its size,
so that nothing of it lies open on a disk; hence :data:`MOST_BYTES`.
"""

from __future__ import annotations

import hashlib
import io
import json
import tarfile
from collections.abc import Iterable
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from carpus.core.errors import BackupIncomplete, BackupUnreadable, SealRefused, TooLargeToSeal
from carpus.core.formats.new_output import new_bytes
from carpus.core.names import is_passphrase
from carpus.core.records.backup import Backup, Content, Kept, Progress, backup_of, check_place, gather, parsed, told
from carpus.core.records.database import STORE_FILE

ENDING = ".tar.age"
LIST_FILE = "carpus-backup.json"
MOST_BYTES = 2_000_000_000
_BEGIN = b"age-encryption.org/v1\n"


def is_sealed(path: Path) -> bool:
    """Whether a file begins as those of age do."""
    with suppress(OSError), path.open("rb") as file:
        return file.read(len(_BEGIN)) == _BEGIN
    return False


def seal_backup(
    data_folder: Path,
    path: Path,
    passphrase: str,
    *,
    software_version: str,
    sessions: Path | None = None,
    settings_folder: Path | None = None,
    now: datetime | None = None,
    progress: Progress = lambda _done, _total: None,
) -> Backup:
    """A back-up as one new file, opened again and compared. Raises :class:`TooLargeToSeal`, :class:`OutputExists` and
    what :func:`core.records.backup.back_up` raises."""
    check_place(data_folder, path)
    sources = gather(data_folder, path, settings_folder, sessions)
    _check_size(path, sources.size_bytes)
    packed, files, lacking = _Packed(), list[Kept](), list(sources.lacking)
    if sources.snapshot:
        files.append(packed.add(STORE_FILE, sources.snapshot, 0))
    done, total = 0, sources.size_bytes or 1
    for name, source, size in sources.files:
        try:
            files.append(packed.add(name, source.read_bytes(), max(0, source.stat().st_mtime_ns)))
        except FileNotFoundError:
            pass  # taken away meanwhile
        except OSError:
            lacking.append(name)
        done += size
        progress(done, total)
    when = (now or datetime.now().astimezone()).replace(microsecond=0)
    made = backup_of(f"{when:%Y-%m-%dT%H%M%S}", when, files, sources.running, len(lacking), software_version)
    packed.add(LIST_FILE, json.dumps(told(made), indent=1).encode(), 0)
    _write(path, packed.close(), passphrase)
    if lacking:
        raise BackupIncomplete(lacking[0], str(len(lacking)))
    return made


def open_sealed(path: Path, passphrase: str) -> tuple[Backup, Content]:
    """A sealed back-up and its contents. Raises :class:`SealRefused`, :class:`BackupUnreadable` for another file."""
    try:
        if path.stat().st_size > 2 * MOST_BYTES:
            raise TooLargeToSeal(path, f"{path.stat().st_size / 1e9:.1f}")
        sealed = path.read_bytes()
    except OSError as cause:
        raise BackupUnreadable(path, cause.strerror or "") from cause
    tar_bytes = _opened(path, sealed, passphrase)
    try:
        tar = tarfile.open(fileobj=io.BytesIO(tar_bytes), mode="r:")  # noqa: SIM115  # in memory, as long as it is read
        members = {member.name: member for member in tar.getmembers() if member.isfile()}
        listed = tar.extractfile(members[LIST_FILE])
        backup = parsed(path.stem, listed.read().decode("utf-8") if listed else "")
    except (tarfile.TarError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError) as cause:
        raise BackupUnreadable(path, str(cause)[:80]) from cause

    def content(one: Kept) -> BinaryIO:
        found = tar.extractfile(members[one.path])
        if found is None:
            raise FileNotFoundError(one.path)
        return found  # type: ignore[return-value]

    return backup, content


def seal_files(files: Iterable[tuple[str, Path]], path: Path, passphrase: str) -> None:
    """Files under their names as one new file. Raises :class:`TooLargeToSeal`, :class:`OutputExists` and others of
    writing."""
    named = list(files)
    _check_size(path, sum(source.stat().st_size for _, source in named))
    packed = _Packed()
    for name, source in named:
        packed.add(name, source.read_bytes(), source.stat().st_mtime_ns)
    _write(path, packed.close(), passphrase)


class _Packed:
    """A tar in memory."""

    def __init__(self) -> None:
        self._bytes = io.BytesIO()
        self._tar = tarfile.open(fileobj=self._bytes, mode="w", format=tarfile.PAX_FORMAT)  # noqa: SIM115

    def add(self, name: str, content: bytes, changed_ns: int) -> Kept:
        about = tarfile.TarInfo(name)
        about.size, about.mode, about.mtime = len(content), 0o600, changed_ns // 1_000_000_000
        self._tar.addfile(about, io.BytesIO(content))
        return Kept(name, hashlib.sha256(content).hexdigest(), len(content), changed_ns)

    def close(self) -> bytes:
        self._tar.close()
        return self._bytes.getvalue()


def _check_size(path: Path, size: int) -> None:
    if size > MOST_BYTES:
        raise TooLargeToSeal(path, f"{size / 1e9:.1f}")


def _write(path: Path, content: bytes, passphrase: str) -> None:
    if not is_passphrase(passphrase):
        raise ValueError("a passphrase of so few signs")
    import pyrage  # loaded when something is sealed

    sealed = bytes(pyrage.passphrase.encrypt(content, passphrase))
    if _opened(path, sealed, passphrase) != content:
        raise SealRefused(path)
    with new_bytes(path) as file:
        file.write(sealed)


def _opened(path: Path, sealed: bytes, passphrase: str) -> bytes:
    import pyrage

    try:
        return bytes(pyrage.passphrase.decrypt(sealed, passphrase))
    except pyrage.DecryptError as cause:
        raise SealRefused(path) from cause
