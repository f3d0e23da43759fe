"""Takes out of a packed folder what OpenCV links against and Carpus never calls (Linux).

OpenCV's libraries are bound to FFmpeg, the AV1 codec, an old TLS library and a second OpenBLAS: code that nobody here
looks after. Carpus reads and writes single pictures, and no film. In place of what OpenCV names come libraries of a few
kilobytes with the same names: that of AV1 refuses; those of FFmpeg end the program if they were ever called; that of
OpenBLAS hands every call to SciPy's OpenBLAS, whose functions are the same with a prefix.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import defaultdict
from pathlib import Path

CODECS = {
    "libavcodec": "cv2/cv2.abi3.so",
    "libavformat": "cv2/cv2.abi3.so",
    "libavutil": "cv2/cv2.abi3.so",
    "libswscale": "cv2/cv2.abi3.so",
    "libaom": "opencv_python_headless.libs/libavif-*",
}
"""And who names them. libavif stays: every picture is shown to it; where one is its own it finds no decoder."""
BEHIND = ("libgfortran", "libquadmath", "libswresample", "libvpx", "libdrm", "libssl", "libcrypto")
"""What only its OpenBLAS and its FFmpeg name."""
REFUSING = ("aom_codec_dec_init_ver", "aom_codec_enc_init_ver")
"""Asked when somebody hands in an AVIF picture: the answer is an error, not the end of the program."""


def _output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def wanted_symbols(library: Path) -> dict[str, str]:
    """Undefined functions of a library, each with the version that it asks for, empty for none."""
    out = {}
    for line in _output("readelf", "--dyn-syms", "--wide", str(library)).splitlines():
        words = line.split()
        if len(words) > 7 and words[6] == "UND":
            name, _, version = words[7].partition("@")
            out[name] = version.strip("@")
    return out


def offered_symbols(library: Path) -> dict[str, str]:
    """Return the functions that a library defines, with their versions."""
    out = {}
    for line in _output("readelf", "--dyn-syms", "--wide", str(library)).splitlines():
        words = line.split()
        if len(words) > 7 and words[6] not in ("UND", "Ndx") and words[3] in ("FUNC", "OBJECT", "IFUNC"):
            name, _, version = words[7].partition("@")
            out[name] = version.strip("@")
    return out


def _soname(library: Path) -> str:
    found = re.search(r"SONAME.*\[(.+)\]", _output("readelf", "--dynamic", str(library)))
    assert found is not None, library
    return found[1]


def _compile(source: str, assembler: str, versions: str, place: Path, soname: str, *arguments: str) -> None:
    folder = place.parent / "slim.tmp"
    folder.mkdir()
    (folder / f"part.{assembler}").write_text(source)
    (folder / "part.map").write_text(versions)
    scripts = [f"-Wl,--version-script={folder / 'part.map'}"] if versions else []
    place.unlink()
    command = ["gcc", "-shared", "-fPIC", "-O1", "-s", "-o", str(place), str(folder / f"part.{assembler}")]
    subprocess.run([*command, f"-Wl,-soname,{soname}", *scripts, *arguments], check=True)
    shutil.rmtree(folder)


def _function(name: str) -> str:
    if name in REFUSING:
        return f"int {name}(void) {{ return 1; }}\n"
    if name.startswith("aom_"):
        return f"void *{name}(void) {{ return NULL; }}\n"
    return f'void {name}(void) {{ fputs("{name}: left out of this program\\n", stderr); abort(); }}\n'


def without_codecs(parts: Path) -> None:
    """Replace the codecs by libraries that only have the names that OpenCV binds to."""
    for name, asker in CODECS.items():
        wanted = {symbol for asking in parts.glob(asker) for symbol in wanted_symbols(asking)}
        (library,) = (parts / "opencv_python_headless.libs").glob(f"{name}-*")
        asked: dict[str, list[str]] = defaultdict(list)
        for symbol, version in offered_symbols(library).items():
            if symbol in wanted:
                asked[version].append(symbol)
        symbols = [symbol for group in asked.values() for symbol in group]
        assert symbols, name
        source = "#include <stdio.h>\n#include <stdlib.h>\n" + "".join(map(_function, symbols))
        versions = "".join(
            f"{version} {{ global: {'; '.join(group)}; }};\n" for version, group in asked.items() if version
        )
        _compile(source, "c", versions, library, _soname(library))


def with_one_blas_less(parts: Path) -> None:
    """Let OpenCV's linear algebra be SciPy's."""
    wanted = wanted_symbols(parts / "cv2" / "cv2.abi3.so")
    (library,) = (parts / "opencv_python_headless.libs").glob("libopenblas*")
    (scipys,) = (parts / "scipy.libs").glob("libscipy_openblas-*")
    there = offered_symbols(scipys)
    symbols = [symbol for symbol in offered_symbols(library) if symbol in wanted]
    missing = [symbol for symbol in symbols if f"scipy_{symbol}" not in there]
    assert symbols, "OpenCV asks its OpenBLAS for nothing"
    assert not missing, missing
    source = ".text\n" + "".join(
        f".globl {one}\n.type {one}, @function\n{one}: jmp scipy_{one}@PLT\n" for one in symbols
    )
    source += '.section .note.GNU-stack,"",@progbits\n'
    folder = f"-L{scipys.parent}"
    _compile(
        source, "s", "", library, _soname(library), folder, f"-l:{scipys.name}", "-Wl,-rpath,$ORIGIN/../scipy.libs"
    )


def strip(parts: Path) -> None:
    """Remove debugging symbols where that does not damage a library.

    The tools that assemble wheels move the sections of a file; after strip such a library may not load.
    """
    folders = ("python3*/lib-dynload", "scipy", "numpy", "yaml", "h5py")
    libraries = [path for folder in folders for path in parts.glob(f"{folder}/**/*.so")]
    for library in (*parts.glob("libpython*.so*"), *libraries):
        stripped = library.with_name(library.name + ".stripped")
        subprocess.run(["strip", "--strip-unneeded", "-o", str(stripped), str(library)], check=True)
        if loads(stripped):
            stripped.replace(library)
        else:
            stripped.unlink()


def loads(library: Path) -> bool:
    """Whether the loader can map a library: every piece begins as far into a page in the file as in memory."""
    for line in _output("readelf", "--segments", "--wide", str(library)).splitlines():
        words = line.split()
        if words[:1] == ["LOAD"]:
            offset, address, align = int(words[1], 16), int(words[2], 16), int(words[-1], 16)
            if (address - offset) % align:
                return False
    return True


def needed(library: Path) -> set[str]:
    """Names of the libraries that one asks for."""
    return set(re.findall(r"NEEDED.*\[(.+)\]", _output("readelf", "--dynamic", str(library))))


def without_unreached(parts: Path) -> None:
    """Remove the system's libraries that only removed parts had needed.

    Libraries that the program loads by name while it runs come with a wheel and lie in its folder.
    """
    top = {path.name: path for path in parts.glob("lib*.so*")}
    roots = [path for path in parts.glob("*/**/*.so*") if not path.is_symlink()]
    waiting = {name for path in roots for name in needed(path)} | {name for name in top if name.startswith("libpython")}
    reached: set[str] = set()
    while waiting:
        name = waiting.pop()
        if name in top and name not in reached:
            reached.add(name)
            waiting |= needed(top[name])
    for name, path in top.items():
        if name not in reached and not path.is_symlink():
            path.unlink()


def with_each_once(parts: Path) -> None:
    """Keep a library once that lies in two wheels' folders."""
    seen: dict[bytes, Path] = {}
    for path in sorted(parts.glob("*.libs/*.so*")):
        first = seen.setdefault(path.read_bytes(), path)
        if first is not path:
            path.unlink()
            path.symlink_to(Path("..") / first.parent.name / first.name)


def slim(parts: Path) -> int:
    """Do all of it in ``parts``; the bytes that were won."""
    before = size(parts)
    without_codecs(parts)
    with_one_blas_less(parts)
    for name in BEHIND:
        for path in (parts / "opencv_python_headless.libs").glob(f"{name}-*"):
            link = parts / path.name
            if link.is_symlink():
                link.unlink()
            path.unlink()
    strip(parts)
    without_unreached(parts)
    with_each_once(parts)
    for link in parts.iterdir():
        assert not link.is_symlink() or link.exists(), f"{link} leads nowhere"
    return before - size(parts)


def size(folder: Path) -> int:
    """Bytes of all files of a folder, as a file system counts them: in blocks."""
    return sum(path.lstat().st_blocks * 512 for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
