"""Where what is known of cameras lies in the data folder, and under which names."""

from __future__ import annotations

import re

CAMERAS = "cameras"
"""Folder of stored calibrations and checks inside the data folder, where back-ups find it."""


def file_stem(serial: str) -> str:
    """A serial number as part of a file's name.

    >>> file_stem("1206/a b")
    '1206-a-b'
    """
    return re.sub(r"[^A-Za-z0-9.]+", "-", serial).strip("-.") or "camera"
