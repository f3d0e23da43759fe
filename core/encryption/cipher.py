"""Opens SQLCipher's files: AES-256 and a check sum with a key for every page, by a library that is kept for just that.

Nothing is encrypted here by our own means. The key of 32 random bytes is handed over as it is; the first half of the
salt, which SQLCipher leaves readable and which need not be secret, is :data:`MARK`, so that a file tells what it is.
"""

from __future__ import annotations

import contextlib
import os
import secrets
from pathlib import Path
from typing import Any

from carpus.core.errors import EncryptionMissing

MARK = b"CARPUSEC"
SALT_BYTES, KEY_BYTES = 16, 32


def is_encrypted(path: Path) -> bool:
    """Whether a file begins as Carpus's encrypted ones do; False where there is none."""
    try:
        with path.open("rb") as file:
            return file.read(len(MARK)) == MARK
    except OSError:
        return False


def new_salt() -> bytes:
    """For a new file."""
    return MARK + secrets.token_bytes(SALT_BYTES - len(MARK))


def salt_of(path: Path) -> bytes:
    """Of a file that is there. Raises OSError."""
    with path.open("rb") as file:
        return file.read(SALT_BYTES)


def library() -> Any:
    """SQLCipher as a DB-API module. Raises :class:`EncryptionMissing` where it is not installed."""
    try:
        from sqlcipher3 import dbapi2
    except ImportError as cause:
        raise EncryptionMissing("", str(cause)) from cause
    return dbapi2


def key_text(key: bytes, salt: bytes) -> str:
    """A key as SQLCipher takes it, without deriving another from it."""
    return f"x'{key.hex()}{salt.hex()}'"


def connect(
    path: Path, key: bytes | None, *, salt: bytes = b"", page_bytes: int = 4096, unchanging: bool = False
) -> Any:
    """A connection in autocommit mode, to a plain database without ``key``; a file that is not there or empty begins
    with ``salt``, or one of its own. ``unchanging``: only read, without locks or journals.

    Whether the key fits shows at the first statement that reads.
    """
    if unchanging:
        connection = library().connect(
            f"{path.absolute().as_uri()}?mode=ro&immutable=1", uri=True, check_same_thread=False, isolation_level=None
        )
    else:
        connection = library().connect(os.fspath(path), check_same_thread=False, isolation_level=None)
    try:
        connection.execute("PRAGMA cipher_log_level = NONE")  # what goes wrong is told as a fault
        if key is not None:
            is_there = path.exists() and path.stat().st_size > 0
            salt = salt_of(path) if is_there else salt or new_salt()
            connection.execute(f'PRAGMA key = "{key_text(key, salt)}"')
            connection.execute(f"PRAGMA cipher_page_size = {page_bytes}")
    except BaseException:
        connection.close()
        raise
    return connection


def remove_database(path: Path) -> None:
    """A database with its journals; nothing where none is."""
    for tail in ("", "-wal", "-shm", "-journal"):
        with contextlib.suppress(OSError):
            path.with_name(path.name + tail).unlink(missing_ok=True)
