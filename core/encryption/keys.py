"""The key of a data folder: 32 random bytes in files that the PIN opens, and known to this process once it was typed.

The PIN is made into a key by Argon2id; that key opens a small SQLCipher file with the folder's own key in it. There are
two such files, since a single damaged byte in the only one would lose everything, and a third that the recovery code
opens. The folder's key stays the same when the PIN changes.
"""

from __future__ import annotations

import os
import secrets
import threading
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path

from carpus.core.durable import sync_folder, write_fault
from carpus.core.encryption.cipher import KEY_BYTES, connect, is_encrypted, library, new_salt, remove_database, salt_of
from carpus.core.errors import FolderLocked, KeyRefused

KEY_FILES = ("encryption.key", "encryption-copy.key")
RECOVERY_FILE = "encryption-recovery.key"
ENDING_FILE = "encryption.ending"
"""There while a folder is being decrypted, so that it goes on after an end."""
PIN_VARIABLE = "CARPUS_PIN"
"""Where the PIN is looked for if nobody can be asked."""
LEAST_SIGNS = 10
"""Files can be carried away and tried as often as a computer can: a short PIN would be found in hours."""
_CODE_SIGNS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"

_ARGON2 = (3, 65536, 4)
"""Rounds, KiB, lanes: RFC 9106, second recommendation. They belong to the key files and stay as they are."""
_WHEREVER = Path()
_known: dict[Path, bytes] = {}
_lock = threading.RLock()
_asking: list[Callable[[Path], str | None]] = []


def ask_with(asking: Callable[[Path], str | None]) -> None:
    """How a PIN is asked for where one is needed and not known; its answer is None where nobody can be asked."""
    _asking[:] = [asking]


def has_key(folder: Path) -> bool:
    """Whether the files of a folder are encrypted, or are becoming so or plain again."""
    return any((folder / name).exists() for name in KEY_FILES)


def is_on(folder: Path) -> bool:
    """Whether what is stored in the folder is to be encrypted."""
    return has_key(folder) and not (folder / ENDING_FILE).exists()


def folder_of(path: Path) -> Path | None:
    """The data folder with a key that a path lies in."""
    there = path.resolve()
    return next((one for one in (there, *there.parents) if has_key(one)), None)


def known_key(path: Path) -> bytes | None:
    """The key of the folder that a path lies in, if it is known by now."""
    folder = folder_of(path)
    with _lock:
        return _known.get(folder) if folder else None


def key_for(path: Path) -> bytes:
    """The key for a file; asked for where it is not known. A file that was carried out of its folder is tried with the
    one key there is. Raises :class:`FolderLocked`, :class:`KeyRefused`."""
    folder = folder_of(path)
    with _lock:
        if _WHEREVER in _known:
            return _known[_WHEREVER]
        if folder is None:
            if len(_known) == 1:
                return next(iter(_known.values()))
            raise FolderLocked(path)
        if folder not in _known:
            pin = _asking[0](folder) if _asking else os.environ.get(PIN_VARIABLE)
            if pin is None:
                raise FolderLocked(path)
            unlock(folder, pin)
        return _known[folder]


def unlock(folder: Path, pin: str) -> None:
    """Open the folder's key by its PIN or its recovery code, and know it from now on; a key file that is damaged or has
    another PIN is written anew. Raises :class:`KeyRefused`."""
    with _lock:
        folder = folder.resolve()
        opened = [_opened(folder / name, pin) for name in KEY_FILES]
        key = next((one for one in opened if one is not None), None)
        if key is None:
            key = _opened(folder / RECOVERY_FILE, _as_code(pin))
        elif None in opened:
            with suppress(OSError):  # a folder that can only be read is opened all the same
                _write(folder / KEY_FILES[opened.index(None)], pin, key)
        if key is None:
            raise KeyRefused(folder)
        _known[folder] = key


def opens(folder: Path, pin: str) -> bool:
    """Whether the PIN or recovery code is the one of the folder's key."""
    places = [(folder / name, pin) for name in KEY_FILES] + [(folder / RECOVERY_FILE, _as_code(pin))]
    return any(_opened(path, secret) is not None for path, secret in places)


def is_code(folder: Path, typed: str) -> bool:
    """Whether it is the folder's recovery code."""
    return _opened(folder / RECOVERY_FILE, _as_code(typed)) is not None


def remember(folder: Path, key: bytes) -> None:
    """Know a key that the owner of this process knows."""
    with _lock:
        _known[folder.resolve()] = key


def use_only(key: bytes | None) -> None:
    """From now on know this key, whatever file it is for, and no other."""
    with _lock:
        _known.clear()
        if key is not None:
            _known[_WHEREVER] = key


def known() -> dict[Path, bytes]:
    """The keys known here, for a process that works for this one (:func:`remember`)."""
    with _lock:
        return dict(_known)


def forget(folder: Path) -> None:
    """Know it no more."""
    with _lock:
        _known.pop(folder.resolve(), None)


def make_key(folder: Path, pin: str) -> str:
    """Give a folder a key, before anything is encrypted with it; the recovery code, which is kept nowhere.

    ValueError for a PIN that is too short or a folder that has a key. Raises :class:`OutputNotWritable`,
    :class:`DiskFull`, :class:`EncryptionMissing`.
    """
    if len(pin) < LEAST_SIGNS or has_key(folder):
        raise ValueError("a short PIN, or a key that is there")
    key = secrets.token_bytes(KEY_BYTES)
    signs = [secrets.choice(_CODE_SIGNS) for _ in range(25)]
    code = "-".join("".join(signs[begin : begin + 5]) for begin in range(0, 25, 5))
    try:
        _write(folder / RECOVERY_FILE, _as_code(code), key)
        for name in KEY_FILES:
            _write(folder / name, pin, key)
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    remember(folder, key)
    return code


def change_pin(folder: Path, pin: str) -> None:
    """Let another PIN open the folder's key, which is known. ValueError for one that is too short."""
    if len(pin) < LEAST_SIGNS:
        raise ValueError("a short PIN")
    key = key_for(folder / KEY_FILES[0])
    try:
        for name in KEY_FILES:
            _write(folder / name, pin, key)
    except OSError as cause:
        raise write_fault(folder, cause) from cause


def remove_key(folder: Path) -> None:
    """For good: only when nothing is encrypted any more. Raises :class:`OutputNotWritable`."""
    try:
        for name in (*KEY_FILES, RECOVERY_FILE, ENDING_FILE):
            (folder / name).unlink(missing_ok=True)
        sync_folder(folder)
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    forget(folder)


def remove_half_written(folder: Path) -> None:
    """Key files that were being written when the program ended; those that were there before are there still."""
    for name in (*KEY_FILES, RECOVERY_FILE):
        for path in folder.glob(f".{name}.*.new"):
            remove_database(path)


def _as_code(typed: str) -> str:
    return "".join(sign for sign in typed.upper() if sign in _CODE_SIGNS)


def _secret_key(pin: str, salt: bytes) -> bytes:
    from argon2.low_level import Type, hash_secret_raw

    rounds, memory_kib, lanes = _ARGON2
    return hash_secret_raw(pin.encode(), salt, rounds, memory_kib, lanes, KEY_BYTES, Type.ID)


def _opened(path: Path, pin: str) -> bytes | None:
    if not is_encrypted(path) or not pin:
        return None
    sql = library()
    try:
        with closing(connect(path, _secret_key(pin, salt_of(path)), unchanging=True)) as box:
            found = bytes(box.execute("SELECT key FROM folder").fetchone()[0])
    except (sql.Error, OSError, TypeError, ValueError):
        return None
    return found if len(found) == KEY_BYTES else None


def _write(path: Path, pin: str, key: bytes) -> None:
    """Beside it first, read back, then in its place. Raises OSError."""
    fresh = path.with_name(f".{path.name}.{secrets.token_hex(4)}.new")
    sql, salt = library(), new_salt()
    try:
        os.close(os.open(fresh, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
        with closing(connect(fresh, _secret_key(pin, salt), salt=salt)) as box:
            box.execute("CREATE TABLE folder (key BLOB NOT NULL)")
            box.execute("INSERT INTO folder VALUES (?)", (key,))
        if _opened(fresh, pin) != key:
            raise OSError(5, "what was written cannot be read back", str(path))
        with fresh.open("r+b") as file:
            os.fsync(file.fileno())
        fresh.replace(path)
        sync_folder(path.parent)
    except sql.Error as cause:
        raise OSError(5, str(cause), str(path)) from cause
    finally:
        remove_database(fresh)
