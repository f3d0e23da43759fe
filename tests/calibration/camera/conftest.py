"""A board shown to the simulator's camera, rendered once for all tests here."""

from __future__ import annotations

import pytest

from carpus.core.calibration.camera.board import CHESSBOARD, ViewCollector, create_board_sheet
from carpus.core.calibration.camera.calibrate import CameraCalibration, calibrate_camera
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.types import Frame
from tests.calibration.camera.printed import ShownSheets
from tests.studio import Studio, poses, render_texture


@pytest.fixture(scope="package")
def studio() -> Studio:
    return Studio(seed=11, depth_scale_error=0.02)


@pytest.fixture(scope="package")
def shown(studio: Studio) -> list[Frame]:
    """All that a person showed of the chessboard, a picture a second."""
    texture = render_texture(create_board_sheet(CHESSBOARD, "a4"))
    return list(ShownSheets(studio, [[placed] for placed in poses(texture)]).frames())


@pytest.fixture(scope="package")
def gathered(shown: list[Frame]) -> ViewCollector:
    """What is kept of it."""
    out = ViewCollector(DEFAULT_CAMERA)
    for frame in shown:
        out.add(frame)
    return out


@pytest.fixture(scope="package")
def made(gathered: ViewCollector) -> CameraCalibration:
    """What is calibrated of it."""
    return calibrate_camera(gathered.views, DEFAULT_CAMERA, "studio")
