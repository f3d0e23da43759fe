"""Brings resources/translations up to date with the sources, by Qt's own tools, and says what is missing.

``make translations`` runs it: ``lupdate`` over the windows and the texts of core, keeping what is there; ``lrelease``
over the result, which refuses a file that is none. What is no longer said goes.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "resources" / "translations"
TOOLS = Path(sys.executable).parent
LANGUAGES = {"de": "de_DE", "it": "it_IT"}


def windows_sources() -> list[Path]:
    """All files whose texts ``lupdate`` reads by itself."""
    return sorted(path for part in ("ui", "app") for path in (ROOT / part).rglob("*.py"))


def hidden_texts() -> dict[str, set[str]]:
    """Texts of ``tr`` inside an f-string, by class (empty outside of one): ``lupdate`` does not look there."""
    found: dict[str, set[str]] = {}

    def walk(node: ast.AST, owner: str, hidden: bool) -> None:
        inside = hidden or isinstance(node, ast.JoinedStr)
        owner = node.name if isinstance(node, ast.ClassDef) else owner
        if inside and isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            if isinstance(node.func, ast.Name) and node.func.id == "tr":
                found.setdefault("", set()).add(node.args[0].value)
            elif isinstance(node.func, ast.Attribute) and node.func.attr == "tr":
                found.setdefault(owner, set()).add(node.args[0].value)
        for child in ast.iter_child_nodes(node):
            walk(child, owner, inside)

    for path in windows_sources():
        walk(ast.parse(path.read_text(encoding="utf-8")), "", False)
    return found


def further_source() -> str:
    """Return a source with all texts that ``lupdate`` does not find by itself."""
    lines = [f"tr({_literal(text)})" for text in phrase_texts()]
    for owner, texts in sorted(hidden_texts().items()):
        indent = "        " if owner else ""
        lines += [f"class {owner}:", "    def words(self):"] if owner else []
        lines += [f"{indent}{'self.' if owner else ''}tr({_literal(text)})" for text in sorted(texts)]
    return "\n".join([*lines, ""])


def phrase_texts() -> list[str]:
    """Return the templates of ``phrase("...")``, sorted; their context is always the empty one."""
    found = set()
    for part in ("core", "app", "ui"):
        for path in (ROOT / part).rglob("*.py"):
            source = path.read_text(encoding="utf-8")
            if "phrase(" in source:
                found |= {text for text, _ in phrase_calls(ast.parse(source))}
    return sorted(found)


def phrase_calls(tree: ast.AST) -> list[tuple[str, ast.Call]]:
    """Return calls of ``phrase`` with their templates; without a literal there is nothing to translate."""
    return [
        (node.args[0].value, node)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "phrase"
        and node.args
        and isinstance(node.args[0], ast.Constant)
        and isinstance(node.args[0].value, str)
    ]


def update(kept: Path, language: str) -> None:
    """Let ``lupdate`` add what is new to one file, and take out what is gone."""
    with TemporaryDirectory() as folder:
        core = Path(folder) / "core_texts.py"
        core.write_text(further_source(), encoding="utf-8")
        sources = [str(path) for path in (*windows_sources(), core)]
        _run("lupdate", *sources, "-locations", "none", "-target-language", language,
             "-source-language", "en_GB",
             "-disable-heuristic", "similartext", "-no-obsolete", "-silent", "-ts", str(kept))  # fmt: skip


def release(kept: Path, compiled: Path) -> None:
    """Let ``lrelease`` compile one file."""
    _run("lrelease", "-silent", str(kept), "-qm", str(compiled))


def missing(kept: Path) -> list[tuple[str, str]]:
    """Context and text of everything without a finished translation."""
    return [
        (context.findtext("name") or "", message.findtext("source") or "")
        for context in ElementTree.parse(kept).iter("context")
        for message in context.iter("message")
        if (translation := message.find("translation")) is None or translation.get("type") == "unfinished"
    ]


def _literal(text: str) -> str:
    """Return a text as the tool reads it: it knows no escapes by number."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def _run(tool: str, *arguments: str) -> None:
    done = subprocess.run([str(TOOLS / f"pyside6-{tool}"), *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{tool}: {done.stderr.strip() or done.stdout.strip()}")


def main() -> None:
    """Both tools over every language; with ``--list`` each missing text."""
    KEPT.mkdir(exist_ok=True)
    for code, name in LANGUAGES.items():
        kept = KEPT / f"carpus_{code}.ts"
        update(kept, name)
        with TemporaryDirectory() as folder:
            release(kept, Path(folder) / "compiled.qm")
        left = missing(kept)
        print(f"{kept.relative_to(ROOT)}: {len(left)} texts without a finished translation")
        if "--list" in sys.argv[1:]:
            for context, text in left:
                print(f"  {context or '-'}: {text}")


if __name__ == "__main__":
    main()
