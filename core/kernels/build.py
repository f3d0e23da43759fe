"""Builds the kernels with this computer's C compiler: ``python core/kernels/build.py``; needs nothing but Python.

A library is called by a digest of what it is made of, so that none of another source, flag or kind of computer is ever
taken for it, and ends in a digest of all that stands before, so that one that was cut short or damaged is not loaded:
the system would end the program. Set-up, the wheel's build and the loader all ask here.
"""

from __future__ import annotations

import hashlib
import os
import platform
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SUFFIX = ".shared"
"""Not the system's own: Python would take it for a module, and PyInstaller for a library to be looked into."""
# No -ffast-math: NaN means "unknown" here and must stay so.
_FLAGS = (
    "-std=gnu11",
    "-O3",
    "-fno-wrapv",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-fopenmp-simd",
    "-fvisibility=hidden",
    "-shared",
)
_WIDE_FLAGS = ("-mavx2", "-mfma", "-ffp-contract=fast")
_SEAL_BYTES = 32
PLAIN, WIDE = "plain", "wide"
"""For every processor of this kind; and for those of x86-64 with AVX2 and FMA, on which a frame takes a tenth less."""


def sources() -> list[Path]:
    """The C files and their header, in order."""
    return sorted((*HERE.glob("*.c"), *HERE.glob("*.h")))


def levels() -> tuple[str, ...]:
    """What is built for this kind of computer."""
    return (PLAIN, WIDE) if platform.machine().lower() in {"x86_64", "amd64"} else (PLAIN,)


def digest() -> str:
    """Of source, flags and kind of computer; twelve hexadecimal digits."""
    made_of = hashlib.sha256(repr((sysconfig.get_platform(), _FLAGS, _WIDE_FLAGS)).encode())
    for path in sources():
        made_of.update(path.name.encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return made_of.hexdigest()[:12]


def library(level: str, made_of: str) -> Path:
    """Where the library of that level and digest lies, once built."""
    return HERE / f"kernels-{made_of}-{level}{SUFFIX}"


def is_whole(path: Path) -> bool:
    """Whether a library is there as it was built: takes half a millisecond. What a system loads as a library may end
    in anything."""
    try:
        content = path.read_bytes()
    except OSError:
        return False
    return content[-_SEAL_BYTES:] == _seal(content[:-_SEAL_BYTES])


def _seal(content: bytes) -> bytes:
    return hashlib.sha256(content).digest()


def built() -> list[Path]:
    """The libraries of this source that are there, built where they are missing or not whole; none where there is no
    compiler.

    Raises ``OSError`` where they cannot be written, ``RuntimeError`` where the compiler fails.
    """
    made_of = digest()
    wanted = {level: library(level, made_of) for level in levels()}
    if all(is_whole(path) for path in wanted.values()):
        return list(wanted.values())
    compiler = next(filter(None, map(shutil.which, (os.environ.get("CC", "cc"), "gcc", "clang"))), None)
    if compiler is None:
        return []
    for stale in HERE.glob(f"kernels-*{SUFFIX}"):
        if stale not in wanted.values():
            stale.unlink(missing_ok=True)
    for level, path in wanted.items():
        _compile(compiler, path, (*_FLAGS, *(_WIDE_FLAGS if level == WIDE else ()), f'-DKERNELS_DIGEST="{made_of}"'))
    return list(wanted.values())


def _compile(compiler: str, path: Path, flags: tuple[str, ...]) -> None:
    """One library, in its place only when it is whole."""
    position = () if sys.platform == "win32" else ("-fPIC",)
    with tempfile.TemporaryDirectory(dir=HERE, prefix=".building-") as folder:
        out = Path(folder) / path.name
        files = [str(source) for source in sources() if source.suffix == ".c"]
        command = [compiler, *flags, *position, "-o", str(out), *files, "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"{compiler} failed: {done.stderr.strip()[-2000:]}")
        content = out.read_bytes()
        out.write_bytes(content + _seal(content))
        out.replace(path)


def main() -> int:
    """Build, and say in one line what could not be; never in the way of a set-up."""
    fault = "no C compiler here; Debian: apt-get install gcc libc6-dev"
    try:
        if built():
            return 0
    except (OSError, RuntimeError) as failed:
        fault = " ".join(str(failed).split())
    sys.stdout.write(f"kernels not built, tracking runs on NumPy alone and takes twice the time ({fault})\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
