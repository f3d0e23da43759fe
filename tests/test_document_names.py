"""Every file and name that a document for readers of the code mentions is there."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCUMENTS = ("resources/method.md", "resources/decisions.md", "CONTRIBUTING.md")
PLACEHOLDER = re.compile(r"NAME|CODE|SUITE|VERSION|DATE|\.\.\.|…")
MADE = {
    "dist/apt",
    "dist/",
    "build/fresh/SUITE.log",
    "build/package-test",
    "parts/PySide6",
    "slim.py",
    "/dev/shm",
    "/var/tmp",
}
"""Files made by a command, of the system, or of what another program installs."""
DOTTED = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)+")
OF_CODE = re.compile(r"[A-Z]\w*[a-z]\w*|[A-Z]+_\w+|_?[a-z]\w*_\w+|_[A-Z]\w+")
"""CamelCase, CONSTANTS and snake_case: no plain word."""
OF_OTHERS = {"tmp_path", "PySide6", "RELEASE_KEY"}


@cache
def defined() -> frozenset[str]:
    """Every name that the program defines, alone and as ``owner.name``: of modules, classes, functions, fields."""
    names: set[str] = set()
    for part in ("app", "core", "ui", "installer", "carpus"):
        for path in (ROOT / part).glob("*.py" if part == "carpus" else "**/*.py"):
            names.add(path.stem)
            names |= {f"{path.stem}.{name}" for name in _within(ast.parse(path.read_text(encoding="utf-8")), names)}
    return frozenset(names)


def _within(owner: ast.AST, names: set[str]) -> set[str]:
    """The names defined directly in a module or class; all of them, and those further in, are added to ``names``."""
    own: set[str] = set()
    for node in ast.iter_child_nodes(owner):
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            own.add(node.name)
            names |= {f"{node.name}.{inner}" for inner in _within(node, names)}
            if isinstance(node, ast.FunctionDef):
                names |= {argument.arg for argument in (*node.args.args, *node.args.kwonlyargs)}
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            own |= {name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)}
    names |= own
    return own


def is_there(told: str) -> bool:
    """Whether what stands between back-ticks exists, or is nothing that could."""
    if told.startswith("make ") and not PLACEHOLDER.search(told):
        return re.search(rf"^{told.split()[1]}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M) is not None
    if " " in told or told in MADE | OF_OTHERS:
        return True
    if PLACEHOLDER.search(told):
        return "/" not in told or (ROOT / told).parent.is_dir()
    if re.fullmatch(r"[\w./-]*(/[\w.-]*|\.(py|md|toml|lock|sh|ps1|yml))", told):
        return (ROOT / told).exists() or ("/" not in told and any(ROOT.glob(f"[!.]*/**/{told}")))
    if re.fullmatch(r"_[a-z]\w{0,2}", told):  # the mark of a frame in a name
        return any(told in name for name in defined())
    if DOTTED.fullmatch(told) or OF_CODE.fullmatch(told):
        return told in defined()
    return True


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_name_in_a_document_is_in_the_program(document: str) -> None:
    told = re.findall(r"`([^`\n]+)`", (ROOT / document).read_text(encoding="utf-8"))
    assert len(told) > 10
    assert [one for one in told if not is_there(one)] == []


def test_what_is_gone_is_found() -> None:
    gone = ("core/tracking/nowhere.py", "nowhere.py", "Camera.nowhere", "association.nowhere", "NoClass", "no_function",
            "make nothing", "_w9", "core/nowhere/NAME.py")  # fmt: skip
    assert [one for one in gone if is_there(one)] == []
