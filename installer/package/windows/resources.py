"""What Windows shows of a program's version, for PyInstaller."""

from __future__ import annotations


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
