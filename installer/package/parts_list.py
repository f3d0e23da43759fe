"""The list of all parts of a packed folder (SBOM, CycloneDX 1.5), and the texts of their licences beside the program.

usage: python parts_list.py FOLDER BILL.cdx.json     (by the Python of the environment that was packed)
"""

from __future__ import annotations

import json
import platform
import re
import shutil
import subprocess
import sys
import uuid
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from carpus.core.platform.about import BundledPart, licence_texts, list_bundled_parts

COMMON = Path("/usr/share/common-licenses")


def system_parts(folder: Path) -> list[BundledPart]:
    """Return the Debian packages whose libraries were packed, by the libraries' names; empty elsewhere."""
    if shutil.which("dpkg-query") is None:
        return []
    names = sorted(path.name for path in (folder / "parts").glob("lib*.so*") if not path.is_symlink())
    patterns = [f"*/{name}" for name in names]
    told = subprocess.run(["dpkg-query", "--search", *patterns], capture_output=True, text=True, check=False).stdout
    packages = sorted({line.partition(": ")[0].partition(":")[0] for line in told.splitlines() if ": /" in line})
    out = []
    for package in packages:
        asked = ["dpkg-query", "--show", "--showformat=${Version}\n", package]
        shown = subprocess.run(asked, capture_output=True, text=True, check=False).stdout.splitlines()
        notice = Path("/usr/share/doc", package, "copyright")
        texts = (notice.read_text(encoding="utf-8", errors="replace"),) if notice.is_file() else ()
        short = sorted(set(re.findall(r"^License: *(\S.*)$", "".join(texts), re.MULTILINE)))
        out.append(BundledPart(package, shown[0] if shown else "", ", ".join(short)[:200], texts))
    return out


def bill(version: str, parts: Iterable[BundledPart]) -> dict[str, Any]:
    """CycloneDX 1.5. The serial number follows from the content: the same parts, the same bill."""
    components = []
    for part in parts:
        component: dict[str, Any] = {"type": "library", "name": part.name, "version": part.version}
        if part.licence:
            component["licenses"] = [{"license": {"name": part.licence}}]
        components.append(component)
    content = {
        "metadata": {"component": {"type": "application", "name": "carpus", "version": version}},
        "components": components,
    }
    serial = uuid.uuid5(uuid.NAMESPACE_OID, json.dumps(content, sort_keys=True))
    head = {"bomFormat": "CycloneDX", "specVersion": "1.5", "serialNumber": f"urn:uuid:{serial}", "version": 1}
    return {**head, **content}


def under(title: str, text: str) -> str:
    """Return a text under its title."""
    return f"{'=' * 80}\n{title}\n{'=' * 80}\n{text}"


def main(folder: Path, place: Path) -> int:
    """Write both."""
    own, *packages = list_bundled_parts()
    python = BundledPart("Python", platform.python_version(), "PSF-2.0")
    starter = BundledPart("PyInstaller bootloader", "", "GPL-2.0-or-later WITH Bootloader-exception")
    libraries = system_parts(folder)
    place.write_text(json.dumps(bill(own.version, [*packages, python, starter, *libraries]), indent=1) + "\n")
    texts = [licence_texts()]
    licence = Path(sys.base_prefix, "lib", f"python{sys.version_info[0]}.{sys.version_info[1]}", "LICENSE.txt")
    licence = licence if licence.is_file() else Path(sys.base_prefix, "LICENSE.txt")
    further = [("Python", licence), *((name, COMMON / name) for name in ("LGPL-3", "GPL-3", "GPL-2", "LGPL-2.1"))]
    texts += [under(name, path.read_text(errors="replace")) for name, path in further if path.is_file()]
    texts += [under(f"{part.name} {part.version}", "".join(part.texts)) for part in libraries]
    (folder / "licences.txt").write_text("\n".join(texts), encoding="utf-8")
    shutil.copyfile(place, folder / "parts.cdx.json")
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
