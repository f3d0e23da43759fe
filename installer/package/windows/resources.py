"""What Windows shows of a program: its icon and its version resource, for PyInstaller.

usage: python resources.py FOLDER     (writes carpus.ico and version.txt there)
"""

from __future__ import annotations

import struct
import sys
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
SIZE_PX = 64
DISCS = ((32, 53), (16, 37), (18, 21), (28.5, 13), (39.5, 14), (49, 23))
"""As in linux/carpus.svg."""
RADIUS_PX = 5.5


def four_numbers(version: str) -> tuple[int, int, int, int]:
    """Windows knows four numbers: ``0.1.0rc2`` is 0.1.0.2, and whatever else is said is dropped."""
    found = [int("".join(filter(str.isdigit, part)) or 0) for part in version.replace("rc", ".").split(".")]
    a, b, c, d = (*found, 0, 0, 0, 0)[:4]
    return a, b, c, d


def version_resource(version: str) -> str:
    """PyInstaller's version file."""
    numbers = four_numbers(version)
    words = {
        "CompanyName": "The Carpus developers",
        "FileDescription": "Carpus: hand rehabilitation",
        "FileVersion": version,
        "LegalCopyright": "MIT licence",
        "ProductName": "Carpus",
        "ProductVersion": version,
    }
    strings = ", ".join(f"StringStruct({name!r}, {value!r})" for name, value in words.items())
    return (
        f"VSVersionInfo(ffi=FixedFileInfo(filevers={numbers}, prodvers={numbers}, mask=0x3f, flags=0x0, OS=0x40004, "
        "fileType=0x1, subtype=0x0, date=(0, 0)), kids=[StringFileInfo([StringTable('040904B0', "
        f"[{strings}])]), VarFileInfo([VarStruct('Translation', [1033, 1200])])])\n"
    )


def icon() -> bytes:
    """An .ico with one picture of 64x64: the six discs."""
    rows = bytearray()
    for v in range(SIZE_PX):
        rows.append(0)
        for u in range(SIZE_PX):
            is_disc = any((u - x) ** 2 + (v - y) ** 2 < RADIUS_PX**2 for x, y in DISCS)
            rows += bytes((31, 95, 208, 255) if is_disc else (244, 246, 248, 255))

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", SIZE_PX, SIZE_PX, 8, 6, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b"")
    png = b"\x89PNG\r\n\x1a\n" + body
    return struct.pack("<HHHBBBBHHII", 0, 1, 1, SIZE_PX, SIZE_PX, 0, 0, 1, 32, len(png), 22) + png


def main(folder: Path) -> int:
    """All of it."""
    from build import version

    folder.mkdir(parents=True, exist_ok=True)
    (folder / "carpus.ico").write_bytes(icon())
    (folder / "version.txt").write_text(version_resource(version()), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
