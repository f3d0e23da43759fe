"""A data folder encrypted at rest: switched on and off, and whatever came into it since encrypted too.

Encrypted are the lists of patients and, of each session, its file, its pictures, the photo of its markers and what a
person chose. Readable stay the names of files (pseudonym, exercise, date), their sizes, the log, set-ups, and a
recording while it runs. Every file is exchanged for its other form on its own; the key is made before the first and
goes after the last, so that a folder that is half way can always be read, and goes on at the next start.
"""

from __future__ import annotations

import contextlib
import glob
import os
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from carpus.core.capture.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.raw import was_closed
from carpus.core.durable import sync_folder, write_fault
from carpus.core.encryption import cipher, content, keys
from carpus.core.encryption.cipher import is_encrypted, key_text, remove_database
from carpus.core.errors import CarpusFault, EncryptionUnfinished, RegisterUnreadable
from carpus.core.library.beside import CHOICES_SUFFIX, COMMENTS_SUFFIX, MARKERS_SUFFIX
from carpus.core.phrase import phrase
from carpus.core.session.disk import is_being_written
from carpus.core.session.register import REGISTER_FILE

ENDINGS = (".h5", RAW_SUFFIX, MARKERS_SUFFIX, CHOICES_SUFFIX, COMMENTS_SUFFIX)

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Swept:
    """``done`` files exchanged; ``left`` faults of those that could not be."""

    done: int
    left: tuple[CarpusFault, ...]


def switch_on(folder: Path, pin: str) -> str:
    """Give the folder its key: from now on what is stored is encrypted, by :func:`sweep`. The recovery code.

    ValueError for a short PIN. Raises what :func:`keys.make_key` does.
    """
    return keys.make_key(folder, pin)


def begin_switching_off(folder: Path) -> None:
    """From now on :func:`sweep` makes everything plain again. Raises :class:`OutputNotWritable`."""
    try:
        os.close(os.open(folder / keys.ENDING_FILE, os.O_WRONLY | os.O_CREAT, 0o600))
        sync_folder(folder)
    except OSError as cause:
        raise write_fault(folder, cause) from cause


def end_switching_off(folder: Path) -> None:
    """Forget the key for good; where anything is encrypted still it is kept, by :class:`EncryptionUnfinished`."""
    own = {*keys.KEY_FILES, keys.RECOVERY_FILE}
    left = [path for path in folder.rglob("*") if path.name not in own and path.is_file() and is_encrypted(path)]
    if left:
        raise EncryptionUnfinished(left[0].name, str(len(left)))
    keys.remove_key(folder)


def sweep(
    folder: Path,
    progress: Progress = lambda _done, _total: None,
    stopping: Callable[[], bool] = lambda: False,
) -> Swept:
    """Bring every file of sessions into the form that the folder asks for; those being written are left for later.

    The folder's key is known. Lists of patients are exchanged by :func:`exchange_lists`.
    """
    if not keys.has_key(folder):
        return Swept(0, ())
    key, wanted = keys.key_for(folder / keys.KEY_FILES[0]), keys.is_on(folder)
    waiting = [path for path in _files(folder) if is_encrypted(path) != wanted]
    total = sum(_size(path) for path in waiting) or 1
    swept, done, left = 0, 0, list[CarpusFault]()
    for path in waiting:
        if stopping():
            break
        try:
            if not (wanted and _is_busy(path)):
                swept += content.encrypt_file(path, key) if wanted else content.decrypt_file(path, key)
        except CarpusFault as fault:
            left.append(fault)
        done += _size(path)
        progress(min(done, total), total)
    return Swept(swept, tuple(left))


def exchange_lists(folder: Path) -> list[CarpusFault]:
    """The lists of patients that nobody has open, and copies of old ones, in the form that the folder asks for; what
    could not be. Raises :class:`FolderLocked`."""
    told: list[CarpusFault] = []
    keys.remove_half_written(folder)
    if keys.has_key(folder):
        content.remove_underway(folder)
        for path in _lists(folder):
            try:
                exchange_list(path)
            except CarpusFault as fault:
                told.append(fault)
    return told


def check_alone(folder: Path) -> None:
    """Raise :class:`RegisterUnreadable` where another program has a list of patients open: it could read nothing any
    more. No list is open here."""
    sql = cipher.library()
    for path in _lists(folder):
        if path.name == REGISTER_FILE and not is_encrypted(path):
            try:
                with closing(cipher.connect(path, None)) as database:
                    database.execute("PRAGMA busy_timeout = 2000")
                    if database.execute("PRAGMA journal_mode = DELETE").fetchone()[0] != "delete":
                        raise RegisterUnreadable(path, phrase("another program has it open"))
            except sql.Error as cause:
                raise RegisterUnreadable(path, phrase("another program has it open: {cause}", cause=cause)) from cause


def exchange_list(path: Path) -> None:
    """One list of patients in the form that its folder asks for; one that is no database is exchanged as a file.

    Raises :class:`RegisterUnreadable` where another program has it open, :class:`DiskFull`, :class:`OutputNotWritable`;
    then it is as it was.
    """
    folder = keys.folder_of(path)
    if folder is None or is_encrypted(path) == keys.is_on(folder):
        return
    key = keys.key_for(path)
    old, new = (None, key) if keys.is_on(folder) else (key, None)
    fresh = content.beside(path, content.UNDERWAY[2])
    sql = cipher.library()
    try:
        _rewrite(path, old, fresh, new)
        with content.PLACING:
            fresh.replace(path)
        sync_folder(path.parent)
    except sql.Error as cause:
        if getattr(cause, "sqlite_errorcode", 0) & 0xFF in (11, 26) and path.name != REGISTER_FILE:  # damaged
            (content.encrypt_file if new else content.decrypt_file)(path, key)
            return
        raise RegisterUnreadable(path, str(cause)) from cause
    except OSError as cause:
        raise write_fault(path, cause) from cause
    finally:
        remove_database(fresh)


def _rewrite(path: Path, old: bytes | None, fresh: Path, new: bytes | None) -> None:
    """Everything of a database into another, compared table by table; nobody else has it open meanwhile."""
    os.close(os.open(fresh, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
    with closing(cipher.connect(path, old)) as database:
        database.execute("PRAGMA busy_timeout = 2000")
        if database.execute("PRAGMA journal_mode = DELETE").fetchone()[0] != "delete":
            raise RegisterUnreadable(path, phrase("another program has it open"))
        database.execute("PRAGMA locking_mode = EXCLUSIVE")
        database.execute("BEGIN EXCLUSIVE")
        database.execute("COMMIT")
        version = int(database.execute("PRAGMA user_version").fetchone()[0])
        secret = key_text(new, cipher.new_salt()) if new else ""
        database.execute("ATTACH DATABASE ? AS fresh KEY ?", (os.fspath(fresh), secret))
        database.execute("SELECT sqlcipher_export('fresh')")
        database.execute(f"PRAGMA fresh.user_version = {version}")
        tables = [str(name) for (name,) in database.execute("SELECT name FROM main.sqlite_master WHERE type = 'table'")]
        for table in tables:
            for one, other in (("main", "fresh"), ("fresh", "main")):
                missing = f'SELECT * FROM {one}."{table}" EXCEPT SELECT * FROM {other}."{table}" LIMIT 1'
                if database.execute(missing).fetchone():
                    raise RegisterUnreadable(path, phrase("what was written is not what was read"))
        database.execute("DETACH DATABASE fresh")
    with closing(cipher.connect(fresh, new)) as written:
        is_whole = written.execute("PRAGMA integrity_check").fetchone()[0] == "ok"
        there = [str(name) for (name,) in written.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        same_version = int(written.execute("PRAGMA user_version").fetchone()[0]) == version
        if not is_whole or not same_version or sorted(there) != sorted(tables):
            raise RegisterUnreadable(path, phrase("what was written cannot be read back"))
    with fresh.open("r+b") as file:
        os.fsync(file.fileno())


def encrypted_share(folder: Path) -> tuple[int, int]:
    """How many of the folder's files are encrypted, and of how many."""
    ours = _ours(folder)
    return sum(is_encrypted(path) for path in ours), len(ours)


def _ours(folder: Path) -> list[Path]:
    return [*_lists(folder), *_files(folder)]


def _lists(folder: Path) -> list[Path]:
    stem, suffix = REGISTER_FILE.split(".")
    return sorted(path for path in folder.rglob(f"{stem}*.{suffix}") if path.is_file() and not path.is_symlink())


def _files(folder: Path) -> Sequence[Path]:
    """Of sessions, smallest first: what is many and quick is done when the rest takes long."""
    found = [
        path
        for path in folder.rglob("*")
        if path.name.endswith(ENDINGS) and not path.name.startswith(".") and path.is_file() and not path.is_symlink()
    ]
    return sorted(found, key=lambda path: (_size(path), path))


def _is_busy(path: Path) -> bool:
    """Whether a recording still writes it, or the session that it lies beside."""
    stem = path.name.split(".")[0]
    if any(path.parent.glob(f"{glob.escape(stem)}.*.part")):
        return True
    with contextlib.suppress(OSError):
        if path.suffix == ".h5":
            return is_being_written(path)
        if path.suffix == RAW_SUFFIX:
            return not was_closed(path) and not path.with_suffix(".h5").exists()
    return False


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
