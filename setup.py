"""What pyproject.toml cannot say: how ``core/compiled`` is built, and that a wheel knows the revision it was built of.

``CARPUS_BOUNDS_CHECKED=1 python setup.py build_ext`` builds the modules with every index checked, for the tests.
"""

import os
import subprocess
from pathlib import Path

from Cython.Build import cythonize
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

IS_CHECKED = bool(os.environ.get("CARPUS_BOUNDS_CHECKED"))
CHECKED_PLACE = Path("build", "checked")
DIRECTIVES = {
    "language_level": 3,
    "infer_types": True,
    "boundscheck": IS_CHECKED,
    "initializedcheck": IS_CHECKED,
    "wraparound": False,
    "cdivision": True,
    "show_performance_hints": not IS_CHECKED,
}
# No -ffast-math: NaN means "unknown" here and must stay so.
FLAGS = ("-O3", "-g0", "-fno-wrapv", "-fno-math-errno", "-fno-trapping-math")
MODULES = sorted(path.stem for path in Path("carpus/core/compiled").glob("*.py") if path.stem != "__init__")


class BuildCompiled(build_ext):
    """Flags are the compiler's own; the checked build lies in a place of its own."""

    def finalize_options(self):
        super().finalize_options()
        if IS_CHECKED:
            self.inplace, self.build_lib, self.build_temp = False, str(CHECKED_PLACE), str(CHECKED_PLACE / "objects")

    def build_extensions(self):
        if self.compiler.compiler_type != "msvc":
            for extension in self.extensions:
                extension.extra_compile_args = list(FLAGS)
        super().build_extensions()


class BuildWithRevision(build_py):
    """Leaves nothing of an earlier build but extensions that are still true; an editable install asks git itself."""

    def run(self):
        if not self.editable_mode:
            for path in Path(self.build_lib).rglob("*"):
                if path.is_file() and not (path.suffix in (".so", ".pyd") and path.name.partition(".")[0] in MODULES):
                    path.unlink()
        super().run()
        if self.editable_mode:
            return
        asked = ["git", "rev-parse", "HEAD"]
        try:
            told = subprocess.run(asked, capture_output=True, text=True, check=True).stdout
        except (OSError, subprocess.CalledProcessError):
            told = ""
        Path(self.build_lib, "carpus/resources/revision.txt").write_text(told, encoding="utf-8")


setup(
    ext_modules=cythonize(
        [
            Extension(
                f"carpus.core.compiled.{name}",
                [f"carpus/core/compiled/{name}.py"],
                define_macros=[("Py_LIMITED_API", "0x030B0000")],  # one wheel for Python 3.11 and all later
                py_limited_api=True,
            )
            for name in MODULES
        ],
        build_dir="build/checked" if IS_CHECKED else "build/cython",
        compiler_directives=DIRECTIVES,
    ),
    cmdclass={"build_ext": BuildCompiled, "build_py": BuildWithRevision},
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
