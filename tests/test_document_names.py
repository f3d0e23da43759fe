"""Every file and name that a document for readers of the code, or a docstring, mentions is there."""

from __future__ import annotations

import ast
import builtins
import importlib
import re
from collections.abc import Iterator
from functools import cache

import pytest

from tests.sources import ROOT, SOURCES, modules, nodes, parse_file

pytestmark = SOURCES

DOCUMENTS = ("resources/method.md", "resources/decisions.md", "CONTRIBUTING.md")
PLACEHOLDER = re.compile(r"NAME|CODE|SUITE|VERSION|DATE|\.\.\.|…")
MADE = {
    "dist/apt", "dist/", "build/fresh/SUITE.log", "build/rendered", "build/package-test", "parts/PySide6", "slim.py",
    "/raw", "/dev/shm", "/var/tmp",
}  # fmt: skip
"""Files made by a command, of the system, or of what another program installs; and a part of a session file."""
DOTTED = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)+")
OF_CODE = re.compile(r"[A-Z]\w*[a-z]\w*|[A-Z]+_\w+|_?[a-z]\w*_\w+|_[A-Z]\w+")
"""CamelCase, CONSTANTS and snake_case: no plain word."""
PARTS = ("app", "core", "ui", "installer")
OF_OTHERS = {"tmp_path", "PySide6", "RELEASE_KEY"}

FORMS = {
    "from_x", "to_x", "Parameters", "Returns", "Raises", "Error", "Notice", "session_saved",
    "test_patient_table_pools_the_rows_of_a_kind",
}  # fmt: skip
"""Forms of names in the rules for them, and headings of docstrings."""


@cache
def defined() -> frozenset[str]:
    """Every name that the program defines, alone and as ``owner.name``: of modules, classes, functions, fields."""
    names: set[str] = set()
    for path in (*modules(*PARTS), *(ROOT / "carpus").glob("*.py")):
        names.add(path.stem)
        names |= {f"{path.stem}.{name}" for name in _within(parse_file(path), names)}
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


@cache
def files() -> frozenset[str]:
    """What files and folders of the checkout are called."""
    return frozenset(path.name for path in ROOT.glob("[!.]*/**/*"))


def is_there(told: str) -> bool:
    """Whether what stands between back-ticks exists, or is nothing that could."""
    if told.startswith("make ") and not PLACEHOLDER.search(told):
        return re.search(rf"^{told.split()[1]}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M) is not None
    if " " in told or told in MADE | OF_OTHERS:
        return True
    if PLACEHOLDER.search(told):
        return "/" not in told or (ROOT / told).parent.is_dir()
    if re.fullmatch(r"[\w./-]*(/[\w.-]*|\.(py|md|toml|lock|sh|ps1|yml))", told):
        return (ROOT / told).exists() or ("/" not in told and told in files())
    if re.fullmatch(r"_[a-z]\w{0,2}", told):  # the mark of a frame in a name
        return any(told in name for name in defined())
    if DOTTED.fullmatch(told) or OF_CODE.fullmatch(told):
        return told in defined()
    return True


@pytest.mark.parametrize("document", DOCUMENTS)
def test_documents_name_existing_things_only(document: str) -> None:
    told = re.findall(r"`([^`\n]+)`", (ROOT / document).read_text(encoding="utf-8"))
    assert len(told) > 10
    told = [one for one in told if one not in FORMS]
    assert [one for one in told if not is_there(one)] == []


def test_document_check_reports_missing_name() -> None:
    gone = ("core/tracking/nowhere.py", "nowhere.py", "Camera.nowhere", "association.nowhere", "NoClass", "no_function",
            "make nothing", "_w9", "core/nowhere/NAME.py")  # fmt: skip
    assert [one for one in gone if is_there(one)] == []


ROLE = re.compile(r":(mod|class|func|meth|data|attr):`~?([^`]+)`")
PLAIN = re.compile(r"(?<![:`])``([^`\n]+)``(?!`)")
FOR_EXAMPLE = {"wrist_flexion_r", "mcp2_flexion_l", "rotation_a_b", "WRIST_FE", "MCP2_flexion"}
"""Names that a docstring puts together as the program does."""


@cache
def docstrings() -> tuple[tuple[str, str], ...]:
    """Each text that stands by itself, of a module, class, function or value, with the file that it stands in."""
    return tuple((where, text) for where, texts, _ in _read() for text in texts)


@cache
def written() -> frozenset[str]:
    """Every word of the code itself: names, attributes, arguments, and what stands in its texts."""
    return frozenset(word for _, _, words in _read() for word in words)


@cache
def _read() -> tuple[tuple[str, tuple[str, ...], frozenset[str]], ...]:
    return tuple((str(path.relative_to(ROOT)), *_said_and_written(nodes(path))) for path in modules(*PARTS))


def _said_and_written(tree: tuple[ast.AST, ...]) -> tuple[tuple[str, ...], frozenset[str]]:
    said = [
        node.value
        for node in tree
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    ]
    return tuple(str(one.value) for one in said), frozenset(_words(tree, {id(one) for one in said}))


def _words(tree: tuple[ast.AST, ...], said: set[int]) -> Iterator[str]:
    for node in tree:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in said:
            yield from re.findall(r"\w+", node.value)
        for name in (getattr(node, field, None) for field in ("id", "attr", "arg", "name", "asname")):
            if isinstance(name, str):
                yield from name.split(".")


def leads_somewhere(role: str, told: str) -> bool:
    """Whether what a role names is in the program, in Python or in a package."""
    if role == "mod" and told.startswith(("core.", "ui.", "app.", "carpus.")):
        path = ROOT / told.removeprefix("carpus.").replace(".", "/")
        return path.is_dir() or path.with_suffix(".py").is_file()
    if told in defined() or told.rsplit(".", 1)[-1] in defined() or hasattr(builtins, told):
        return True
    module, _, name = told.rpartition(".")
    try:
        found = importlib.import_module(module or told)
    except ImportError:
        return False
    return role == "mod" or hasattr(found, name)


def is_written(told: str) -> bool:
    """Whether what a docstring shows as code is written somewhere in it; a file, a value or a sentence may be."""
    if not (OF_CODE.fullmatch(told) or DOTTED.fullmatch(told)) or told in FOR_EXAMPLE or PLACEHOLDER.search(told):
        return True
    last = told.rsplit(".", 1)[-1]
    return (
        told in defined() or last in written() or hasattr(builtins, told) or bool(re.search(r"\.[a-z0-9]{1,4}$", told))
    )


def test_docstrings_name_existing_things_only() -> None:
    told = [(where, role, name) for where, text in docstrings() for role, name in ROLE.findall(text)]
    assert len(told) > 300
    assert [one for one in told if not leads_somewhere(*one[1:])] == []
    shown = [(where, name) for where, text in docstrings() for name in PLAIN.findall(text)]
    assert len(shown) > 1000
    assert [one for one in shown if not is_written(one[1])] == []


def test_docstring_check_reports_missing_name() -> None:
    gone = (
        ("mod", "core.library"),
        ("class", "NoClass"),
        ("meth", "Camera.nowhere_at_all"),
        ("func", "numpy.no_such_function"),
    )
    assert [one for one in gone if leads_somewhere(*one)] == []
    assert [one for one in ("no_such_field", "NoClass", "state.no_such_field") if is_written(one)] == []
