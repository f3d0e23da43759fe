"""Provenance: version, source revision and SHA-256 of files, recordings and settings."""

from __future__ import annotations

import hashlib
import json
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from carpus.core.platform.version import __version__

REVISION_FILE = "revision.txt"
"""Resource of an installed program; a checkout knows its revision itself."""
TIMEOUT_S = 10.0
HASHED_LISTS = ("rgb.txt", "depth.txt", "camera_info.yaml")


@cache
def source_revision() -> str:
    """Return the source revision of this program, 40 digits; empty if unknown."""
    root = Path(__file__).resolve().parents[2]
    if (root / ".git").exists():
        with suppress(OSError, subprocess.SubprocessError):
            command = ["git", "-C", str(root), "rev-parse", "HEAD"]
            return subprocess.run(command, capture_output=True, text=True, check=True, timeout=TIMEOUT_S).stdout.strip()
    with suppress(OSError, ModuleNotFoundError):
        return resources.files("carpus.resources").joinpath(REVISION_FILE).read_text(encoding="utf-8").strip()
    return ""


def version_with_revision() -> str:
    """Return ``0.1.0 (1a2b3c4)``, or the version alone if the revision is unknown."""
    known = source_revision()
    return f"{__version__} ({known[:7]})" if known else __version__


def parameter_section(parameters: str, section: str) -> dict[str, Any]:
    """Return a section of a session's parameters, such as ``provenance``; empty if there is none."""
    try:
        parsed = json.loads(parameters)[section]
    except (KeyError, TypeError, ValueError):
        return {}
    return parsed if isinstance(parsed, dict) else {}


def sha256_of_file(path: Path) -> str:
    """Return the SHA-256 of a file. Raises OSError."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def sha256_of_settings(settings: Any) -> str:
    """Return the SHA-256 of settings as JSON with sorted names and no spaces."""
    return hashlib.sha256(json.dumps(settings, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def sha256_of_recording(path: Path) -> str:
    """Return the SHA-256 of a recording: of its file, or of a folder's lists and the frames in them.

    For a folder it is that of lines ``SHA256 NAME``, sorted by name, as ``sha256sum`` writes them but with one space.
    Other files do not count. Raises OSError.
    """
    if path.is_file():
        return sha256_of_file(path)
    lines = (f"{sha256_of_file(path / name)} {name}\n" for name in sorted(set(_listed_files(path))))
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def _listed_files(folder: Path) -> Iterator[str]:
    for name in HASHED_LISTS:
        if (folder / name).is_file():
            yield name
            if name.endswith(".txt"):
                for line in (folder / name).read_text(encoding="utf-8", errors="replace").splitlines():
                    words = line.split()
                    if len(words) > 1 and not line.startswith("#") and (folder / words[1]).is_file():
                        yield words[1]
