"""A recording of the second patient: a TUM folder with camera file, clicks, and what of its discs can be seen."""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from pathlib import Path

import cv2
import numpy as np
import platformdirs

from carpus.core.calibration.clicks_file import write_clicks
from carpus.core.calibration.result import Clicks
from carpus.core.capture.camera_info import CAMERA_FILE, write_camera_info
from carpus.core.capture.files.tum import COLOR_LIST, DEPTH_LIST, SIMULATED_REMARK
from carpus.core.model.types import FloatArray, Side
from tests.second_patient.discs import NAMES
from tests.second_patient.motions import SECONDS, Row, make_motion
from tests.second_patient.patient import Hung, Truth, make_patient
from tests.second_patient.pictures import Look, Sensor, expose, read_depth, render_color, render_depth

CLICKS_FILE, VISIBLE_FILE = "calibration.json", "visible_share.npy"
# Read when this is imported: a file edited while its recording is drawn must not name what it did not draw.
_SOURCE = b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("[!_]*.py")))

EPOCH_S = 1_720_000_000.0
FPS = 30.0
_CLICK_SD, _CLICK_MOST = 0.25, 0.45
_PNG = [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY]


class Take:
    """The recording of a row and a seed before it is rendered; sides by parity, as in the table's other rows.

    ``time_s``, ``depth_time_s`` (N,) of its pictures after the first.
    """

    def __init__(self, row: Row, seed: int, side: Side | None = None, seconds: float = SECONDS) -> None:
        rng, self.seed, self.motion = np.random.default_rng([seed, 2003]), seed, make_motion(row.motion, seed)
        side = side or ("left" if seed % 2 else "right")
        self.patient = make_patient(seed, side, self.motion(np.zeros(1)), rigid=row.rigid)
        self.hung = Hung(seed, self.patient.mirror)
        count = int(seconds * FPS)
        self.time_s = np.arange(count) / FPS + np.concatenate(([0.0], rng.uniform(-8e-4, 8e-4, count - 1)))
        self.depth_time_s = self.time_s + float(rng.uniform(0.001, 0.007))
        stamp_s = np.round(EPOCH_S + self.time_s, 6)
        self.truth = Truth(row, self.patient, self.motion, self.hung, self.time_s, stamp_s)

    def radius_px(self) -> FloatArray:
        """Radius (M,) of each disc in the first picture, as if it faced the camera."""
        radius_m = self.patient.stuck.size_m[[NAMES.index(name) for name in self.truth.protocol.markers]]
        return np.asarray(self.truth.camera.fx_px * radius_m / self.truth.disc_position_cam_m[0, :, 2])

    def clear_px(self) -> float:
        """The least room between the edges of two discs in the first picture."""
        middle, radius = self.truth.disc_pixel[0], self.radius_px()
        apart = np.linalg.norm(middle[:, None] - middle[None], axis=-1) - radius[:, None] - radius[None]
        return float(apart[~np.eye(len(middle), dtype=bool)].min())

    def clicks_px(self) -> FloatArray:
        """A person's clicks (M, 2) on the first picture: on the paper, off its middle by some of its radius."""
        middle = self.truth.camera.distort(self.truth.disc_pixel[0])
        off = np.random.default_rng([self.seed, 2111]).normal(0.0, _CLICK_SD, middle.shape)
        return np.round(middle + np.clip(off, -_CLICK_MOST, _CLICK_MOST) * self.radius_px()[:, None], 1)


def record_take(take: Take, folder: Path) -> Truth:
    """Render a take into ``folder``, which must not hold one."""
    (folder / "rgb").mkdir(parents=True)
    (folder / "depth").mkdir()
    truth = take.truth
    look = Look(take.patient, take.hung, take.seed)
    sensor = Sensor(take.seed, (truth.camera.height_px, truth.camera.width_px))
    stuck = np.isin(NAMES, truth.protocol.markers)
    rows = [NAMES.index(name) for name in truth.protocol.markers]
    lists: dict[str, list[str]] = {"rgb": [], "depth": []}
    posture, later = take.motion(take.time_s), take.motion(take.depth_time_s)
    for i in range(len(take.time_s)):
        now, then = (every.moment(i) for every in (posture, later))
        light, seen = render_color(take.patient, take.hung, look, take.patient.body(now), stuck)
        depth = render_depth(take.patient, take.hung, look, take.patient.body(then))
        truth.visible_share[i] = seen[rows]
        color = expose(sensor, light, i)
        for kind, stamp_s, picture in (
            ("rgb", truth.timestamp_s[i], cv2.cvtColor(color, cv2.COLOR_RGB2BGR)),
            ("depth", EPOCH_S + take.depth_time_s[i], read_depth(sensor, depth, i)),
        ):
            name = f"{kind}/{stamp_s:.6f}.png"
            lists[kind].append(f"{stamp_s:.6f} {name}")
            if not cv2.imwrite(str(folder / name), picture, _PNG):
                raise OSError(f"{folder / name} could not be written")
    np.save(folder / VISIBLE_FILE, truth.visible_share)
    write_clicks(folder / CLICKS_FILE, Clicks(truth.side, truth.protocol, take.clicks_px()))
    write_camera_info(folder / CAMERA_FILE, truth.camera, registered=True, mirrored=False)
    for kind, title, name in (("rgb", "color images", COLOR_LIST), ("depth", "depth maps", DEPTH_LIST)):
        text = "\n".join([f"# {title}", SIMULATED_REMARK, "# timestamp filename", *lists[kind], ""])
        (folder / name).write_text(text, encoding="utf-8")
    return truth


def cache_recording(row: Row, seed: int, seconds: float = SECONDS) -> tuple[Path, Truth]:
    """Folder and truth of a recording, rendered only when the user's cache does not hold it as it would be now."""
    take = Take(row, seed, seconds=seconds)
    drawn = _SOURCE + repr((row, seed, seconds)).encode()
    key = hashlib.sha256(drawn).hexdigest()[:20]
    root = Path(platformdirs.user_cache_dir("carpus", appauthor=False)) / "second_patient"
    folder = root / key
    if (folder / VISIBLE_FILE).exists():
        take.truth.visible_share = np.load(folder / VISIBLE_FILE)
        return folder, take.truth
    root.mkdir(parents=True, exist_ok=True)
    part = Path(tempfile.mkdtemp(prefix=f"{key}.", dir=root))
    try:
        truth = record_take(take, part / "take")
        (part / "take").rename(folder)
    finally:
        shutil.rmtree(part, ignore_errors=True)
    return folder, truth
