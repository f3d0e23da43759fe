"""A file's content as an encrypted file that is read from any place, and the way there and back without a gap.

A file is exchanged under its own name: the other form is written beside it, brought to the disk, read back and compared
with what was there, and only then takes the name. Whenever that ends, one of the two is there whole.
"""

from __future__ import annotations

import hashlib
import io
import os
import threading
import uuid
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any, BinaryIO

from carpus.core.durable import sync_folder, write_fault
from carpus.core.encryption.cipher import connect, is_encrypted, library, remove_database
from carpus.core.encryption.keys import key_for
from carpus.core.errors import CarpusFault, ContentDamaged, ContentUnequal
from carpus.core.phrase import phrase
from carpus.core.private import private

BLOCK = 1 << 20
PAGE_BYTES = 65536
BLOCKS_HELD = 8
VERSION = 1
UNDERWAY = (".encrypting", ".decrypting", ".exchanging")
"""Endings of what is being written; left behind by an end, it is removed."""
PLACING = threading.RLock()
"""Held while a file takes the place of another of its name, so that no change and no erasure is undone by it."""


class EncryptedContent(io.RawIOBase):
    """What is in an encrypted file, as a binary file that is only read. Raises :class:`ContentDamaged` for a file that
    does not fit its check sums or its key."""

    def __init__(self, path: Path, key: bytes) -> None:
        super().__init__()
        self._path = path
        self._position = 0
        self._held: OrderedDict[int, bytes] = OrderedDict()
        try:
            self._connection = connect(path, key, page_bytes=PAGE_BYTES, unchanging=True)
        except library().Error as cause:
            raise ContentDamaged(path, str(cause)) from cause
        try:
            facts = dict(self._ask("SELECT name, value FROM fact"))
            if int(facts["version"]) > VERSION:
                raise ContentDamaged(
                    path,
                    phrase(
                        "version {version}, this Carpus reads up to {newest}", version=facts["version"], newest=VERSION
                    ),
                )
            self.size, self.sha256 = int(facts["size"]), str(facts["sha256"])
        except (KeyError, ValueError, TypeError) as cause:
            self._connection.close()
            raise ContentDamaged(path, phrase("its facts are not there")) from cause
        except CarpusFault:
            self._connection.close()
            raise

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = 0) -> int:
        begin = {0: 0, 1: self._position, 2: self.size}[whence]
        self._position = max(0, begin + offset)
        return self._position

    def tell(self) -> int:
        return self._position

    def readinto(self, buffer: Any) -> int:
        view = memoryview(buffer).cast("B")
        done = 0
        while done < len(view) and self._position < self.size:
            number, inside = divmod(self._position, BLOCK)
            piece = self._block(number)[inside : inside + len(view) - done]
            view[done : done + len(piece)] = piece
            done += len(piece)
            self._position += len(piece)
        return done

    def close(self) -> None:
        if not self.closed:
            self._connection.close()
        super().close()

    def _block(self, number: int) -> bytes:
        if number in self._held:
            self._held.move_to_end(number)
            return self._held[number]
        rows = self._ask("SELECT bytes FROM content WHERE number = ?", (number,))
        wanted = min(BLOCK, self.size - number * BLOCK)
        if len(rows) != 1 or len(rows[0][0]) != wanted:
            raise ContentDamaged(self._path, phrase("block {number} is not there", number=number))
        self._held[number] = rows[0][0]
        if len(self._held) > BLOCKS_HELD:
            self._held.popitem(last=False)
        return bytes(rows[0][0])

    def _ask(self, question: str, values: tuple[Any, ...] = ()) -> list[Any]:
        try:
            return list(self._connection.execute(question, values).fetchall())
        except library().Error as cause:
            raise ContentDamaged(self._path, str(cause)) from cause


def open_kept(path: Path) -> BinaryIO:
    """A file of the data folder for reading, encrypted or not. Raises OSError, :class:`FolderLocked`,
    :class:`ContentDamaged`."""
    if is_encrypted(path):
        return io.BufferedReader(EncryptedContent(path, key_for(path)), BLOCK)
    return path.open("rb")


def read_kept(path: Path) -> bytes:
    """All of it, as :func:`open_kept`."""
    with open_kept(path) as file:
        return file.read()


def encrypt_file(path: Path, key: bytes) -> bool:
    """Exchange a plain file for an encrypted one; False where it was changed or taken away meanwhile, and left as it
    is. Raises :class:`DiskFull`, :class:`OutputNotWritable`, :class:`ContentUnequal`; then the plain one is there."""
    return _exchange(path, UNDERWAY[0], lambda fresh: _write_encrypted(path, fresh, key))


def decrypt_file(path: Path, key: bytes) -> bool:
    """The way back, as :func:`encrypt_file`. Raises :class:`ContentDamaged` too."""
    return _exchange(path, UNDERWAY[1], lambda fresh: _write_plain(path, fresh, key))


def write_encrypted(path: Path, content: bytes, key: bytes) -> None:
    """A new encrypted file in the place of what has the name. Raises :class:`DiskFull`, :class:`OutputNotWritable`."""
    fresh = beside(path, UNDERWAY[0])
    try:
        _put_content(fresh, (content,), key)
        with PLACING:
            fresh.replace(path)
        sync_folder(path.parent)
    except OSError as cause:
        raise write_fault(path, cause) from cause
    finally:
        remove_database(fresh)


def remove_underway(folder: Path) -> None:
    """What an exchange left behind that was ended."""
    for ending in UNDERWAY:
        for path in folder.rglob(f".*{ending}*"):
            if path.is_file():
                remove_database(path)


def _exchange(path: Path, ending: str, write: Callable[[Path], None]) -> bool:
    fresh = beside(path, ending)
    try:
        before = path.stat()
        write(fresh)
        os.utime(fresh, ns=(before.st_atime_ns, before.st_mtime_ns))
        with PLACING:
            now = path.stat()
            if (before.st_size, before.st_mtime_ns, before.st_ino) != (now.st_size, now.st_mtime_ns, now.st_ino):
                return False
            fresh.replace(path)
        sync_folder(path.parent)
    except FileNotFoundError:
        return False
    except OSError as cause:
        raise write_fault(path, cause) from cause
    finally:
        remove_database(fresh)
    return True


def beside(path: Path, ending: str) -> Path:
    """A name of its own for what is written in place of a file: another program may be at the same file."""
    return path.with_name(f".{path.name}.{uuid.uuid4().hex[:8]}{ending}")


def _write_encrypted(path: Path, fresh: Path, key: bytes) -> None:
    with path.open("rb") as file:
        sha256 = _put_content(fresh, iter(lambda: file.read(BLOCK), b""), key)
    with EncryptedContent(fresh, key) as written:
        if _digest(written) != sha256:
            raise ContentUnequal(path)


def _write_plain(path: Path, fresh: Path, key: bytes) -> None:
    with EncryptedContent(path, key) as content, open(fresh, "xb", opener=private) as plain:
        sha256 = content.sha256
        while block := content.read(BLOCK):
            plain.write(block)
        plain.flush()
        os.fsync(plain.fileno())
    with fresh.open("rb") as written:
        if _digest(written) != sha256:
            raise ContentUnequal(path)


def _put_content(fresh: Path, blocks: Iterator[bytes] | tuple[bytes, ...], key: bytes) -> str:
    """Write a new encrypted file and bring it to the disk; the SHA-256 of what is in it."""
    digest, size, number = hashlib.sha256(), 0, 0
    os.close(os.open(fresh, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
    sql = library()
    try:
        with closing(connect(fresh, key, page_bytes=PAGE_BYTES)) as made:
            made.execute("PRAGMA journal_mode = OFF")
            made.execute("PRAGMA synchronous = OFF")  # it is brought to the disk as a whole, below
            made.execute("BEGIN")
            made.execute("CREATE TABLE content (number INTEGER PRIMARY KEY, bytes BLOB NOT NULL)")
            made.execute("CREATE TABLE fact (name TEXT PRIMARY KEY, value TEXT NOT NULL)")
            for given in blocks:
                for begin in range(0, len(given), BLOCK):
                    block = given[begin : begin + BLOCK]
                    made.execute("INSERT INTO content VALUES (?, ?)", (number, block))
                    digest.update(block)
                    size, number = size + len(block), number + 1
            facts = {"version": VERSION, "size": size, "sha256": digest.hexdigest()}
            made.executemany("INSERT INTO fact VALUES (?, ?)", [(name, str(value)) for name, value in facts.items()])
            made.execute("COMMIT")
    except sql.Error as cause:
        raise _as_os_error(fresh, cause) from cause
    with fresh.open("r+b") as file:
        os.fsync(file.fileno())
    return digest.hexdigest()


def _as_os_error(path: Path, cause: Exception) -> OSError:
    import errno

    full = getattr(cause, "sqlite_errorcode", 0) & 0xFF == 13
    return OSError(errno.ENOSPC if full else errno.EIO, str(cause), str(path))


def _digest(file: Any) -> str:
    digest = hashlib.sha256()
    while block := file.read(BLOCK):
        digest.update(block)
    return digest.hexdigest()
