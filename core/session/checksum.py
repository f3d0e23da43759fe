"""The seal of a finished session: one SHA-256 over all that the file says, so that any later change shows.

A check sum in each chunk (HDF5's Fletcher32) finds a flipped bit when the values are read; the seal also covers
texts, attributes, names and what was left out. It has no key: whoever changes a file on purpose can seal it anew.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from typing import Any

import h5py
import numpy as np

CHECKSUM_ATTRIBUTE = "seal"
PREFIX = "sha256:"
_BLOCK_BYTES = 1 << 23


def compute_checksum(file: h5py.File, known: Mapping[str, str] | None = None) -> str:
    """The seal that belongs to a file as it is; datasets whose digests are ``known`` need not be read again."""
    known = known or {}
    whole = hashlib.sha256()
    for place, thing in _iter_objects(file):
        whole.update(f"{place}\n".encode())
        for name in sorted(thing.attrs):
            if (place, name) != ("/", CHECKSUM_ATTRIBUTE):
                whole.update(f"@{name} {_serialize_attribute(thing.attrs[name])}\n".encode())
        if isinstance(thing, h5py.Dataset):
            digest = known.get(place) or hash_dataset(thing)
            whole.update(f"={_format_dtype(thing.dtype)} {tuple(map(int, thing.shape))} {digest}\n".encode())
    return PREFIX + whole.hexdigest()


def hash_dataset(dataset: h5py.Dataset) -> str:
    """The digest of all values of a dataset, read in pieces."""
    out = hashlib.sha256()
    if dataset.shape == ():
        out.update(to_bytes(np.asarray(dataset[()])))
        return out.hexdigest()
    row_bytes = max(1, int(np.prod(dataset.shape[1:])) * dataset.dtype.itemsize)
    step = max(1, _BLOCK_BYTES // row_bytes)
    if dataset.chunks:
        step = max(dataset.chunks[0], step // dataset.chunks[0] * dataset.chunks[0])
    for begin in range(0, dataset.shape[0], step):
        out.update(to_bytes(np.asarray(dataset[begin : begin + step])))
    return out.hexdigest()


def _iter_objects(file: h5py.File) -> Iterator[tuple[str, Any]]:
    """Every group and dataset in the order of their paths."""
    places: list[str] = []
    file.visit(places.append)
    yield "/", file
    for place in sorted(places):
        yield "/" + place, file[place]


def to_bytes(values: np.ndarray) -> bytes:
    """Values as they go into a digest."""
    if values.dtype.kind != "O":
        return np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"), copy=False).tobytes()
    texts = [text if isinstance(text, bytes) else str(text).encode() for text in values.ravel().tolist()]
    return b"".join(b"%d:%s" % (len(text), text) for text in texts)


def _format_dtype(dtype: np.dtype) -> str:
    return "text" if dtype.kind == "O" else dtype.newbyteorder("<").str


def _serialize_attribute(value: Any) -> str:
    """An attribute as one text, the same for every way of storing the same thing."""
    if isinstance(value, bytes):
        return repr(value.decode("utf-8", "replace"))
    if isinstance(value, np.ndarray):
        return "[" + ", ".join(_serialize_attribute(one) for one in value.ravel().tolist()) + "]"
    if isinstance(value, np.generic):
        return _serialize_attribute(value.item())
    return repr(value)
