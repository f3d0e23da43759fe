"""The documentation as a site: README, resources and guide as they are, and the Python interface from its docstrings.

``make docs`` runs it with the tools of ``requirements-docs.lock``, in an environment of their own. The pages keep their
places in a copy, so that their links hold; a link or an anchor that leads nowhere ends it. Site: ``build/site``.
"""

from __future__ import annotations

import ast
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
PAGES, CONFIG, SITE = ROOT / "build" / "docs", ROOT / "build" / "docs.yml", ROOT / "build" / "site"
SOURCE, TUTORIALS = ROOT / "build" / "docs-source", ROOT / "build" / "tutorials"
FIRST = ("README", "CONTRIBUTING", "CHANGELOG", "SECURITY", "CODE_OF_CONDUCT")
BESIDE = ("LICENSE", "CITATION.cff", "pyproject.toml")
LANGUAGES = {"en": "Guide", "de": "Anleitung", "it": "Guida"}
RESOURCES = {
    "Method": ("method", "accuracy", "performance", "untried", "decisions"),
    "Research notes": ("research-notes/accuracy", "research-notes/performance"),
    "For researchers": ("api", "formats", "session-format", "validation", "clusters", "glossary"),
}
OTHERS = "Keeping it running"
"""Of all that no heading names."""
REFERENCE = {
    "carpus.app.opened_session": ("open_session", "open_sessions", "OpenedSession"),
    "carpus.app.python_api": (
        "track", "write_session", "simulate", "propose_clicks", "export", "compare",
        "HandFrame", "Wrist", "ProposedClicks",
    ),
    "carpus.core.session.values": ("Session", "SessionHeader", "Motion", "MarkerSeries", "QualitySeries", "Event",
                                   "Repetitions", "RepetitionRow"),
    "carpus.core.formats.measures_table": ("MeasureRow",),
    "carpus.core.simulation.spec": ("RecordingSpec",),
    "carpus.core.simulation.truth": ("Truth",),
    "carpus.core.calibration.result": ("Calibration", "Clicks"),
    "carpus.core.formats.export": ("ExportResult", "RefusedSession"),
    "carpus.core.research.agreement.compare": ("Comparison", "AnglePairs", "Alignment"),
    "carpus.core.research.agreement.time_alignment": ("ClockShift",),
    "carpus.core.research.agreement.statistics": ("Agreement",),
    "carpus.core.model.types": ("KinematicState", "Frame"),
    "carpus.core.model.camera": ("Camera",),
    "carpus.core.model.errors": ("CarpusFault",),
}  # fmt: skip
"""Functions of ``import carpus``, and the classes that they take and return."""
LOGO = "resources/carpus.svg"
SEARCH_FRAME = "iframe-worker.js"
"""The plugin ``offline`` would load it from the net, which a folder without one has not."""
COMMANDS = {
    "Without a command, and to try": ("demo", "review"),
    "Recordings and sessions": ("simulate", "record", "track", "recover", "info", "verify"),
    "Results": ("results", "progress", "report", "export"),
    "Studies": ("compare", "retest"),
    "Cameras": ("doctor", "calibrate-camera", "check-card"),
    "Data folder": ("backup", "restore", "log", "erase"),
}


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
    if TUTORIALS.is_dir():
        shutil.copytree(TUTORIALS, PAGES / "resources/tutorials")
        page = PAGES / "resources/api.md"
        page.write_text(page.read_text(encoding="utf-8").replace(".ipynb)", ".md)"), encoding="utf-8")
    else:
        shutil.copytree(ROOT / "resources/tutorials", PAGES / "resources/tutorials")
    shutil.copy(ROOT / "installer" / SEARCH_FRAME, PAGES)
    shutil.copy(ROOT / LOGO, PAGES / LOGO)
    (PAGES / "python.md").write_text(reference(), encoding="utf-8")
    (PAGES / "commands.md").write_text(command_page(), encoding="utf-8")


def reference() -> str:
    """Page of the Python interface, from the code: a copy of it, whose roles are the site's own marks."""
    lines = ["# Python interface", ""]
    for module, names in REFERENCE.items():
        path = Path(*module.split(".")[1:]).with_suffix(".py")
        text = re.sub(r":\w+:`[~.]*(?:[\w.]+\.)?(\w+)`", r"``\1``", (ROOT / path).read_text(encoding="utf-8"))
        # An attribute with its meaning in the same line: the meaning would be taken for its type.
        text = re.sub(r"(?m)^(    \w[\w, ]*) : (.+)$(?!\n {8})", r"\1\n        \2", text)
        copy = SOURCE / "carpus" / path
        for folder in (copy.parent, *copy.parent.relative_to(SOURCE).parents):
            (SOURCE / folder).mkdir(parents=True, exist_ok=True)
            if folder != Path():
                (SOURCE / folder / "__init__.py").touch()
        copy.write_text(text, encoding="utf-8")
        lines += [line for name in names for line in (f"::: {module}.{name}", "")]
    return "\n".join(lines)


HELP = """
import json, sys
from carpus.app.__main__ import build_parser
parsers = {name: build_parser([name])._subparsers._group_actions[0].choices[name] for name in json.loads(sys.argv[1])}
print(json.dumps({name: parser.format_help() for name, parser in parsers.items()}))
"""


def command_page() -> str:
    """Page of the commands, from their own help."""
    names = json.dumps([name for names in COMMANDS.values() for name in names])
    asked = [ROOT / ".venv/bin/python", "-c", HELP, names]
    environment = {**os.environ, "COLUMNS": "100"}
    done = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=True, env=environment)
    told = json.loads(done.stdout)
    lines = ["# Commands", ""]
    for title, some in COMMANDS.items():
        lines += [f"## {title}", ""]
        for name in some:
            lines += [f"### carpus {name}", "", "```text", told[name].rstrip(), "```", ""]
    return "\n".join(lines)


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
        {"Tutorials": sorted(str(path.relative_to(PAGES)) for path in (PAGES / "resources/tutorials").glob("*.md"))},
        {"Reference": ["commands.md", "python.md"]},
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
    """Return the settings of MkDocs."""
    options = {
        "docstring_style": "numpy", "show_signature_annotations": True, "separate_signature": True,
        "show_root_heading": True, "show_root_full_path": False, "show_source": False, "heading_level": 2,
        "merge_init_into_class": True, "line_length": 88,
    }  # fmt: skip
    python = {"paths": [str(SOURCE)], "options": options}
    return {
        "site_name": "Carpus",
        "docs_dir": str(PAGES),
        "site_dir": str(SITE),
        "use_directory_urls": False,  # read from a folder, without a server
        "theme": {
            "name": "material",
            "font": False,
            "logo": LOGO,
            "favicon": LOGO,
            "palette": {"primary": "teal"},
            "features": ["navigation.tabs", "search.suggest", "toc.integrate"],
        },
        "plugins": ["search", "offline", {"mkdocstrings": {"handlers": {"python": python}}}],
        "extra": {"polyfills": [SEARCH_FRAME]},
        "markdown_extensions": ["tables", "toc", "attr_list"],
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
        (SITE / "404.html").unlink()  # for a server; in a folder it finds neither style nor page
        print(f"{SITE / 'index.html'}: {sum(1 for _ in SITE.rglob('*.html'))} pages")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
