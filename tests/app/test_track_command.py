"""What ``carpus track`` says on the side."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.__main__ import main


@pytest.mark.parametrize(("option", "warned"), [("--depth", False), ("--no-depth", True)])
def test_colour_alone_is_warned_of(
    option: str, warned: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    missing = tmp_path / "none"
    arguments = ["track", str(missing), "--calibration", str(missing), "--output", str(tmp_path / "out.h5"), option]
    assert main(arguments) == 1
    said = capsys.readouterr().err
    assert ("mirror image" in said) == warned
    assert str(missing) in said
