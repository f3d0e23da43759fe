"""The file of clicks: the agreed form is read, everything else is named."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.clicks_file import read_clicks, write_clicks
from carpus.core.calibration.result import Clicks
from carpus.core.model.errors import (
    CarpusFault,
    ClickOutsideImage,
    ClicksUnreadable,
    OutputExists,
    OutputNotWritable,
    ProtocolUnknown,
)
from carpus.core.model.hand.protocols import HAND21, WRIST6

MARKERS = {
    "MCP5": [260.5, 200],
    "WRIST": [317.2, 301.5],
    "CMC1": [295.0, 290.1],
    "MCP2": [300.0, 210.0],
    "MCP3": [310.0, 205.0],
    "MCP4": [320.0, 207.0],
}
GOOD: dict[str, Any] = {"hand": "right", "protocol": "wrist6", "markers": MARKERS}


def write(path: Path, content: Any) -> Path:
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def test_write_clicks_are_read_back(tmp_path: Path) -> None:
    pixel = np.random.default_rng(0).uniform(0, 480, (21, 2))
    path = tmp_path / "c.json"
    write_clicks(path, Clicks("left", HAND21, pixel))
    again = read_clicks(path)
    assert (again.side, again.protocol) == ("left", HAND21)
    np.testing.assert_array_equal(again.pixel, pixel)
    content = json.loads(path.read_text())
    assert set(content) == {"hand", "protocol", "markers"}
    assert content["markers"]["TIP5"] == pixel[20].tolist()


@pytest.mark.parametrize("said", [(True, True, False, True, True), (True,) * 5])
def test_write_clicks_keeps_straight_fingers(tmp_path: Path, said: tuple[bool, ...]) -> None:
    path = tmp_path / "c.json"
    write_clicks(path, Clicks("left", HAND21, np.zeros((21, 2)), said))
    assert read_clicks(path).straight_fingers == said
    assert read_clicks(write(tmp_path / "d.json", GOOD)).straight_fingers == ()
    for wrong in ([True] * 4, "yes", [1] * 5):
        with pytest.raises(ClicksUnreadable, match="straight_fingers"):
            read_clicks(write(tmp_path / "e.json", GOOD | {"straight_fingers": wrong}))


def test_write_clicks_existing_file_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "c.json", "mine")
    clicks = Clicks("left", WRIST6, np.zeros((6, 2)))
    with pytest.raises(OutputExists):
        write_clicks(path, clicks)
    assert path.read_text() == "mine"
    with pytest.raises(OutputNotWritable):
        write_clicks(tmp_path / "nowhere" / "c.json", clicks)


def markers(**change: Any) -> dict[str, Any]:
    return GOOD | {"markers": MARKERS | change}


BAD: dict[str, tuple[Any, type[CarpusFault], str]] = {
    "empty": ("", ClicksUnreadable, "not JSON, line 1"),
    "no object": ([1, 2], ClicksUnreadable, "object"),
    "nested without end": ("[" * 100_000, ClicksUnreadable, "not JSON"),
    "third hand": (GOOD | {"hand": "both"}, ClicksUnreadable, '"both"'),
    "unknown protocol": (GOOD | {"protocol": "foot26"}, ProtocolUnknown, "wrist6, hand21"),
    "other protocol": (GOOD | {"protocol": "hand21"}, ClicksUnreadable, "no click for DIP2"),
    "markers as a list": (GOOD | {"markers": [[1, 2]] * 6}, ClicksUnreadable, "no markers"),
    "extra marker": (markers(TIP2=[1, 2]), ClicksUnreadable, "unknown marker TIP2"),
    "a word": (markers(MCP2=["300", 210]), ClicksUnreadable, "MCP2"),
    "not a number": (markers(MCP2=[float("nan"), 210]), ClicksUnreadable, "MCP2"),
    "hundreds of digits": (markers(MCP2=[10**400, 210]), ClicksUnreadable, "MCP2"),
    "true": (markers(MCP2=[True, 210]), ClicksUnreadable, "MCP2"),
    "three numbers": (markers(MCP2=[1, 2, 3]), ClicksUnreadable, "MCP2"),
    "marker twice": (json.dumps(GOOD).replace('"CMC1"', '"WRIST"'), ClicksUnreadable, "WRIST appears twice"),
    "left of the picture": (markers(MCP2=[-3, 210]), ClickOutsideImage, "-3, 210"),
    "right of the picture": (markers(MCP2=[640, 210]), ClickOutsideImage, "640 x 480"),
    "under the picture": (markers(MCP2=[300, 1e6]), ClickOutsideImage, "1e+06"),
}


@pytest.mark.parametrize("case", BAD)
def test_read_clicks_invalid_file_is_refused_with_reason(tmp_path: Path, case: str) -> None:
    content, kind, fact = BAD[case]
    path = write(tmp_path / "c.json", content)
    with pytest.raises(kind) as caught:
        read_clicks(path, 640, 480)
    assert type(caught.value) is kind
    assert fact in caught.value.detail


def test_read_clicks_missing_or_binary_file_is_refused(tmp_path: Path) -> None:
    binary = tmp_path / "binary.json"
    binary.write_bytes(b"\xff\xfe\x00\x01")
    for path, why in ((tmp_path / "nowhere.json", "file not found"), (binary, "not a text file"), (tmp_path, "")):
        with pytest.raises(ClicksUnreadable) as caught:
            read_clicks(path)
        assert why in caught.value.detail
