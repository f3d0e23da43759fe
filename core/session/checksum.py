"""Checksum of a finished session: one SHA-256 over its whole content, so that any later change shows.

Each chunk also has a checksum (HDF5's Fletcher32), which finds a flipped bit when values are read. The SHA-256 also
covers texts, attributes and names. It has no key: whoever changes a file on purpose can compute it again.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

import h5py
import numpy as np

CHECKSUM_ATTRIBUTE = "seal"
PREFIX = "sha256:"
_BLOCK_BYTES = 1 << 23


def compute_checksum(file: h5py.File, known: Mapping[str, str] | None = None) -> str:
    """Return the checksum of a file; datasets with ``known`` digests are not read again."""
    known = known or {}
    whole = hashlib.sha256()
    paths: list[str] = []
    file.visit(paths.append)
    for place in ("/", *(f"/{path}" for path in sorted(paths))):
        thing = file[place]
        whole.update(f"{place}\n".encode())
        for name in sorted(thing.attrs):
            if (place, name) != ("/", CHECKSUM_ATTRIBUTE):
                whole.update(f"@{name} {_serialize_attribute(thing.attrs[name])}\n".encode())
        if isinstance(thing, h5py.Dataset):
            digest = known.get(place) or hash_dataset(thing)
            dtype = "text" if thing.dtype.kind == "O" else thing.dtype.newbyteorder("<").str
            whole.update(f"={dtype} {tuple(map(int, thing.shape))} {digest}\n".encode())
    return PREFIX + whole.hexdigest()


def hash_dataset(dataset: h5py.Dataset) -> str:
    """Return the SHA-256 of all values of a dataset, read in pieces."""
    digest = hashlib.sha256()
    if dataset.shape == ():
        digest.update(to_bytes(np.asarray(dataset[()])))
        return digest.hexdigest()
    row_bytes = max(1, int(np.prod(dataset.shape[1:])) * dataset.dtype.itemsize)
    step = max(1, _BLOCK_BYTES // row_bytes)
    if dataset.chunks:
        step = max(dataset.chunks[0], step // dataset.chunks[0] * dataset.chunks[0])
    for begin in range(0, dataset.shape[0], step):
        digest.update(to_bytes(np.asarray(dataset[begin : begin + step])))
    return digest.hexdigest()


def to_bytes(values: np.ndarray) -> bytes:
    """Return values as bytes for hashing."""
    if values.dtype.kind != "O":
        return np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"), copy=False).tobytes()
    texts = [text if isinstance(text, bytes) else str(text).encode() for text in values.ravel().tolist()]
    return b"".join(b"%d:%s" % (len(text), text) for text in texts)


def _serialize_attribute(value: Any) -> str:
    """Return an attribute as text, the same for every way of storing the same value."""
    if isinstance(value, bytes):
        return repr(value.decode("utf-8", "replace"))
    if isinstance(value, np.ndarray):
        return "[" + ", ".join(_serialize_attribute(one) for one in value.ravel().tolist()) + "]"
    if isinstance(value, np.generic):
        return _serialize_attribute(value.item())
    return repr(value)
