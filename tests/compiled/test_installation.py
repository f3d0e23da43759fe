"""That what is not compiled is told, and what runs is what the sources say."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

import pytest

from carpus.core import compiled
from carpus.core.capture import doctor
from carpus.core.compiled import find_uncompiled, mixture
from carpus.core.model.errors import CompiledPartMissing


def test_modules_run_compiled() -> None:
    assert mixture.__file__.endswith(tuple(EXTENSION_SUFFIXES))
    assert find_uncompiled(Path(compiled.__file__).parent) == []


def test_source_without_its_extension_is_named(tmp_path: Path) -> None:
    of_another_python = f"other.cpython-399{EXTENSION_SUFFIXES[-1]}"
    for name in ("__init__.py", "one.py", f"one{EXTENSION_SUFFIXES[0]}", "other.py", of_another_python):
        (tmp_path / name).touch()
    assert find_uncompiled(tmp_path) == ["other"]


def test_doctor_tells_what_is_not_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    assert doctor.check_compiled_parts().state == "good"

    def broken(name: str) -> None:
        raise CompiledPartMissing("mixture")

    monkeypatch.setattr(doctor, "import_module", broken)
    finding = doctor.check_compiled_parts()
    assert (finding.state, "mixture" in finding.observation) == ("bad", True)
    assert finding.remedy


@pytest.mark.parametrize("extension", [None, b"cut short"])
def test_tracking_with_a_part_not_compiled_ends_with_one_sentence(tmp_path: Path, extension: bytes | None) -> None:
    source = Path(compiled.__file__).parent
    for path in source.glob("*.py"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
        if extension is not None and path.stem != "__init__":
            (tmp_path / f"{path.stem}{EXTENSION_SUFFIXES[-1]}").write_bytes(extension)
    code = (
        "import sys, importlib.util as u; from carpus.app.__main__ import main;"
        f"spec = u.spec_from_file_location('carpus.core.compiled', {str(tmp_path / '__init__.py')!r},"
        f" submodule_search_locations=[{str(tmp_path)!r}]); m = u.module_from_spec(spec);"
        "f = type('F', (), {'find_spec': staticmethod(lambda n, *a: spec if n == 'carpus.core.compiled' else None)});"
        "sys.meta_path.insert(0, f); sys.exit(main(['track', 'nowhere', '--output', 'w.csv']))"
    )
    environment = {name: value for name, value in os.environ.items() if name != "CARPUS_UNCOMPILED"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "not installed completely" in done.stderr
    assert ("mixture" if extension is None else "association") in done.stderr
    assert done.stderr.count("\n") == 1
