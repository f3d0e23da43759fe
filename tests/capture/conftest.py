"""What the tests of cameras share."""

from __future__ import annotations

import pytest

from carpus.core.model.errors import CarpusFault


@pytest.fixture
def notices() -> list[CarpusFault]:
    """What a camera says of itself while it runs."""
    return []


@pytest.fixture
def short_retry(monkeypatch: pytest.MonkeyPatch) -> None:
    """A camera that was lost is looked for at once."""
    monkeypatch.setattr("carpus.core.capture.devices.process_camera.RETRY_S", 0.05)
