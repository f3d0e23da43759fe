"""The documentation as a site: README, resources and guide as they are, and the Python interface from its docstrings.

``make docs`` runs it with the tools of ``requirements-docs.lock``, in an environment of their own. The pages keep their
places in a copy, so that their links hold; a link or an anchor that leads nowhere ends it. Site: ``build/site``.
"""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
PAGES, CONFIG, SITE = ROOT / "build" / "docs", ROOT / "build" / "docs.yml", ROOT / "build" / "site"
FIRST = ("README", "CONTRIBUTING", "CHANGELOG", "SECURITY", "CODE_OF_CONDUCT")
BESIDE = ("LICENSE", "CITATION.cff")
LANGUAGES = {"en": "Guide", "de": "Anleitung", "it": "Guida"}
RESOURCES = {
    "Method": ("method", "accuracy", "performance", "untried", "decisions"),
    "Research notes": ("research-notes/accuracy", "research-notes/performance"),
    "For researchers": ("api", "formats", "session-format", "validation", "clusters", "glossary"),
}
OTHERS = "Keeping it running"
"""Of all that no heading names."""
PYTHON = """# Python interface

::: carpus.app.python_api
    options:
      members: [track, write_session, open_session, simulate, propose_clicks, export, compare]
      show_root_toc_entry: false
"""


def lay_out() -> None:
    """All pages with what they show, in their own places."""
    shutil.rmtree(PAGES, ignore_errors=True)
    (PAGES / "resources").mkdir(parents=True)
    for name in (*(f"{page}.md" for page in FIRST), *BESIDE):
        shutil.copy(ROOT / name, PAGES / name)
    for path in (ROOT / "resources").glob("*.md"):
        shutil.copy(path, PAGES / "resources")
    for name in ("guide", "pictures", "research-notes"):
        shutil.copytree(ROOT / "resources" / name, PAGES / "resources" / name)
    for page in (PAGES / "resources/guide").glob("*/*.md"):  # the window looks for pictures in their own folder
        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"\]\(([\w-]+\.(?:png|jpg))\)", r"](../pictures/\1)", text), encoding="utf-8")
    (PAGES / "python.md").write_text(PYTHON, encoding="utf-8")


def navigation() -> list[object]:
    """Every page once."""
    named = [name for names in RESOURCES.values() for name in names]
    others = sorted({path.stem for path in (PAGES / "resources").glob("*.md")} - set(named))
    headings = {**RESOURCES, OTHERS: others}
    guides = {
        title: [f"resources/guide/{code}/{page}.md" for page in guide_pages()] for code, title in LANGUAGES.items()
    }
    return [
        "README.md",
        *({title: pages} for title, pages in guides.items()),
        *({title: [f"resources/{name}.md" for name in names]} for title, names in headings.items()),
        {"Python": "python.md"},
        {"Working on it": [f"{name}.md" for name in FIRST[1:]]},
    ]


def guide_pages() -> tuple[str, ...]:
    """Return the pages in the order of the window's guide, whose module needs Qt."""
    tree = ast.parse((ROOT / "ui/screens/help/guide.py").read_text(encoding="utf-8"))
    values = (
        node.value for node in tree.body if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "PAGES"
    )
    pages: tuple[str, ...] = ast.literal_eval(next(values))
    return pages


def config() -> dict[str, object]:
    """What MkDocs is told."""
    return {
        "site_name": "Carpus",
        "docs_dir": str(PAGES),
        "site_dir": str(SITE),
        "use_directory_urls": False,  # read from a folder, without a server
        "theme": {"name": "material", "font": False, "features": ["navigation.tabs", "search.suggest"]},
        "plugins": ["search", {"mkdocstrings": {"handlers": {"python": {"paths": [str(ROOT)]}}}}],
        "validation": {
            "nav": {"omitted_files": "warn", "not_found": "warn"},
            "links": {"not_found": "warn", "anchors": "warn", "unrecognized_links": "warn"},
        },
        "nav": navigation(),
    }


def main() -> int:
    """Build the site; 1 where a link leads nowhere."""
    lay_out()
    CONFIG.write_text(yaml.safe_dump(config(), sort_keys=False), encoding="utf-8")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", str(CONFIG)]
    done = subprocess.run(command, check=False)
    if done.returncode == 0:
        print(f"{SITE / 'index.html'}: {sum(1 for _ in SITE.rglob('*.html'))} pages")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
