"""The whole calibration of a camera: intrinsics, depth, and what is said of both."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.calibration.camera.depth import MOST_APART_PX, DepthCheck, check_depth
from carpus.core.calibration.camera.solve import FAIR_PX, Intrinsics, solve_intrinsics
from carpus.core.calibration.camera.views import BoardView, Judgement, board_of, judge
from carpus.core.camera import Camera


@dataclass(frozen=True, slots=True)
class CameraCalibration:
    """``before`` is what the source said of itself; ``depth`` None where no depth came with the pictures."""

    before: Camera
    intrinsics: Intrinsics
    depth: DepthCheck | None
    judgement: Judgement
    board: str

    @property
    def is_usable(self) -> bool:
        """Whether it may be used: corners land fairly where they should, and depth, where there is any, lies on
        colour; otherwise a session would be measured worse than before and not know it."""
        fits = self.intrinsics.error_px <= FAIR_PX
        return fits and (self.depth is None or self.depth.is_registered)


def calibrate_camera(views: Sequence[BoardView], before: Camera, subject: str) -> CameraCalibration:
    """Calibrate from kept views; raises what :func:`solve_intrinsics` does."""
    intrinsics = solve_intrinsics(views, before.width_px, before.height_px, subject)
    judgement = judge(views, before.width_px, before.height_px)
    depth = check_depth(views, intrinsics, before.sensor)
    return CameraCalibration(before, intrinsics, depth, judgement, board_of(views).name())


def calibration_lines(made: CameraCalibration) -> list[str]:
    """The result for people, one line each."""
    found, before, depth = made.intrinsics, made.before, made.depth
    camera, focal = found.camera, f"{found.camera.fx_px:.1f} x {found.camera.fy_px:.1f}"
    middle = f"{camera.cx_px:.1f}, {camera.cy_px:.1f}"
    near, far = (f"{distance_m * 100:.0f}" for distance_m in (made.judgement.nearest_m, made.judgement.farthest_m))
    out = [
        f"Board: {made.board}, {len(found.used)} pictures, {near} to {far} cm away",
        f"Lines land within {found.error_px:.2f} px ({found.error_in_words})",
        f"Focal length: {focal} ± {found.focal_sd_px:.1f} px (was {before.fx_px:.1f} x {before.fy_px:.1f})",
        f"Middle of the picture: {middle} ± {found.middle_sd_px:.1f} px (was {before.cx_px:.1f}, {before.cy_px:.1f})",
    ]
    if depth is None:
        return [*out, "Depth: not checked, too few pictures with depth on the board"]
    shift = f"shift {depth.offset_m * 1e3:+.1f} ± {depth.offset_sd_m * 1e3:.1f} mm"
    shift = shift if math.isfinite(depth.offset_sd_m) else "no sure shift"
    out.append(f"{depth.in_words()} Scale {100.0 * (depth.scale - 1.0):+.2f} ± {100.0 * depth.scale_sd:.2f} %, {shift}")
    apart = float((depth.apart_px**2).sum() ** 0.5)
    judged = f"good: below {MOST_APART_PX:g} px" if depth.is_registered else "depth does not lie on colour"
    return [*out, f"Colour and depth: {apart:.1f} ± {depth.apart_sd_px:.1f} px apart ({judged})"]
