"""The second camera: intrinsics of its own with a little distortion, hung over the table at its own angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from tests.second_patient.skeleton import about_x, about_y, about_z

_DOWN = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""From the room to a camera that looks straight down, fingers to the top of the picture."""


@dataclass(frozen=True, slots=True)
class Hung:
    """A camera in the room: ``turn`` (3, 3) and ``shift_m`` (3,) take points of the room to its axes; the table top is
    ``table_m`` below the room's zero."""

    camera: Camera
    turn: FloatArray
    shift_m: FloatArray
    table_m: float

    def to_camera(self, room_m: FloatArray) -> FloatArray:
        """Points (..., 3) of the room in the camera's axes."""
        return room_m @ self.turn.T + self.shift_m

    def pixel(self, cam_m: FloatArray) -> FloatArray:
        """Where the lens puts points (..., 3) in the picture, distortion included; (..., 2)."""
        x, y = cam_m[..., 0] / cam_m[..., 2], cam_m[..., 1] / cam_m[..., 2]
        k1, k2, p1, p2, k3 = self.camera.distortion
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        u = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)
        v = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y
        camera = self.camera
        return np.stack((camera.fx_px * u + camera.cx_px, camera.fy_px * v + camera.cy_px), axis=-1)


def hang_camera(seed: int, mirror: FloatArray) -> Hung:
    """The camera of a seed over a hand whose room is ``mirror``-ed."""
    rng = np.random.default_rng([seed, 1511])
    focal = float(rng.uniform(522.0, 552.0))
    camera = Camera(
        round(focal, 2),
        round(focal * float(rng.uniform(0.997, 1.003)), 2),
        round(319.5 + float(rng.uniform(-7.0, 7.0)), 2),
        round(239.5 + float(rng.uniform(-7.0, 7.0)), 2),
        distortion=(round(float(rng.uniform(0.0, 0.04)), 4), round(float(rng.uniform(-0.08, 0.0)), 4), 0.0, 0.0, 0.0),
        origin="file",
    )
    tilt, lean, yaw = np.radians(rng.uniform([-5.0, -5.0, -14.0], [6.0, 5.0, 14.0]))
    turn = about_x(tilt) @ about_y(lean) @ about_z(yaw) @ _DOWN
    middle = np.array([0.025, 0.0, 0.0])
    distance = float(rng.uniform(0.64, 0.76))
    aim = np.array([rng.uniform(-0.03, 0.03), rng.uniform(0.0, 0.03), distance])
    shift = aim - turn @ (mirror * middle)
    return Hung(camera, turn, shift, float(rng.uniform(0.085, 0.12)))
