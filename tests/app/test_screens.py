"""Every screen stands in the table of places: it has a page of the guide, and whoever leads to it names it as it is."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from carpus.app.compose import Desktop
from carpus.ui.flow import ASIDE, STEPS, TABS, Flow
from carpus.ui.help import guide

ROOT = Path(__file__).parents[2]
NAMED = re.compile(r"""way\.(?:show|go|aside)\("(\w+)"|\bplace (?:==|!=) "(\w+)\"""")


@pytest.fixture
def flows(open_desktop: Callable[..., Desktop]) -> dict[str, Flow]:
    return open_desktop().journey.way.flows


def test_every_screen_has_a_page_and_every_place_that_is_named_is_there(flows: dict[str, Flow]) -> None:
    assert {*STEPS, *TABS, *ASIDE, "patients"} <= set(flows)
    assert {flow.guide for flow in flows.values()} <= set(guide.PAGES)
    assert {flow.tab for flow in flows.values()} <= {*TABS, ""}
    sources = [path for part in ("app", "ui") for path in (ROOT / part).rglob("*.py")]
    named = {one for path in sources for found in NAMED.findall(path.read_text("utf-8")) for one in found if one}
    assert "review" in named
    assert named <= set(flows)
