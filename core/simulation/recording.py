"""Writer of a simulated recording: TUM RGB-D folder with clicks, camera file and true values."""

from __future__ import annotations

import contextlib
import dataclasses
import multiprocessing
import shutil
import signal
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from itertools import islice
from pathlib import Path

import cv2
import numpy as np
import platformdirs

from carpus.core.calibration.clicks_file import write_clicks
from carpus.core.calibration.result import Clicks
from carpus.core.capture.camera_info import CAMERA_FILE, write_camera_info
from carpus.core.capture.files.tum import COLOR_LIST, DEPTH_LIST, DEPTH_UNIT_M, SIMULATED_REMARK
from carpus.core.capture.source import SourceInfo
from carpus.core.model.errors import OutputExists, OutputNotWritable
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.types import SIMULATED, ByteImage, DepthImage, FloatArray, Frame
from carpus.core.platform.durable import write_fault
from carpus.core.simulation.disturbances import FrameTimes, sample_covered_markers, sample_frame_times
from carpus.core.simulation.render import CleanImage, Renderer
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.sensor import ColorSensor, create_depth_sensor
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.truth import RECORDING_EPOCH_S, Truth, compute_truth, write_truth

CLICKS_FILE, TRUTH_FILE = "calibration.json", "truth.h5"

_LARGEST_CLICK_ERROR_PX = 3.5
_BLUR_STEP_PX = 1.3
_MAX_SUBFRAMES = 5
_PNG_LEVEL = [cv2.IMWRITE_PNG_COMPRESSION, 1]

Progress = Callable[[int, int], None]
"""Called with the frames done and the number of frames."""


class SimulatedRecording:
    """All frames of one spec, reproducible in any order."""

    def __init__(self, spec: RecordingSpec) -> None:
        self.spec = spec
        self.scene = Scene(spec)
        self.times: FrameTimes = sample_frame_times(spec)
        self.truth: Truth = compute_truth(self.scene, self.times)
        self._renderer = Renderer(self.scene)
        self._color_sensor = ColorSensor(spec, self._renderer.appearance)
        self._depth_sensor = create_depth_sensor(spec, self.scene.camera)
        self._is_covered = sample_covered_markers(spec, self.times.color_s)

    def __len__(self) -> int:
        return len(self.times.color_s)

    def render_clean(self, i: int) -> CleanImage:
        """Render frame i without sensor noise; depth at its own, later time."""
        time_s, depth_time_s = float(self.times.color_s[i]), float(self.times.depth_s[i])
        image = self._renderer.render(time_s, self._is_covered[i])
        offsets_s = self._blur_offsets(i)
        for offset_s in offsets_s:
            other = self._renderer.render(time_s + offset_s, self._is_covered[i])
            image = dataclasses.replace(image, color=image.color + other.color)
        if offsets_s:
            image = dataclasses.replace(image, color=image.color / np.float32(1 + len(offsets_s)))
        if self._max_marker_motion_m(time_s, depth_time_s) > 1e-4:
            depth_m = self._renderer.render_depth(depth_time_s, self._is_covered[i])
            image = dataclasses.replace(image, depth_m=depth_m)
        return image

    def visible_share(self, i: int) -> FloatArray:
        """Return the visible share (M,) of each marker's paper in frame i."""
        return self._renderer.render(float(self.times.color_s[i]), self._is_covered[i]).visible_share

    def apply_sensor(self, i: int, clean: CleanImage) -> tuple[ByteImage, DepthImage]:
        """Return the camera's images of a clean image."""
        return self._color_sensor.expose(clean.color, i), self._depth_sensor.measure(clean.depth_m, i, clean.color)

    def frames(self) -> Iterator[Frame]:
        for i in range(len(self)):
            color, depth = self.apply_sensor(i, self.render_clean(i))
            timestamp_s, dropped = float(self.truth.timestamp_s[i]), int(self.times.dropped_before[i])
            yield Frame(i, timestamp_s, color, depth, DEPTH_UNIT_M, dropped)

    def _max_marker_motion_m(self, from_s: float, to_s: float) -> float:
        """Return the motion of the fastest marker between two times."""
        markers = self.scene.markers_w0_m(self.scene.pose(np.array([from_s, to_s])))
        return float(np.linalg.norm(markers[1] - markers[0], axis=-1).max())

    def _blur_offsets(self, i: int) -> list[float]:
        """Return further times around the middle of the exposure that blur the image."""
        exposure_s = self.spec.exposure_s
        if exposure_s <= 0.0:
            return []
        t = float(self.times.color_s[i])
        blur_px = self._max_marker_motion_m(t - 0.5 * exposure_s, t + 0.5 * exposure_s) * self.scene.camera.fx_px
        blur_px /= float(self.scene.translation_w0_cam_m[2])
        pairs = min(int(blur_px / (2.0 * _BLUR_STEP_PX) + 0.5), _MAX_SUBFRAMES // 2)
        steps = [exposure_s * k / (2 * pairs + 1) for k in range(1, pairs + 1)]
        return [sign * step for step in steps for sign in (-1.0, 1.0)]


def sample_clicks(truth: Truth) -> Clicks:
    """Draw a person's clicks on the first frame, off by ``spec.click_error_px``."""
    spec = truth.spec
    rng = spec.generator(RandomStream.CLICKS)
    error = rng.normal(0.0, 1.0, truth.marker_px[0].shape) * spec.click_error_px
    limit = max(_LARGEST_CLICK_ERROR_PX, spec.click_error_px)
    pixel = np.round(truth.marker_px[0] + np.clip(error, -limit, limit), 1)
    exercise = next((one.id for one in EXERCISES if one.simulated_motion == spec.motion), "")
    return Clicks(spec.hand, spec.marker_protocol, pixel, exercise=exercise)


def simulate(spec: RecordingSpec, folder: Path, progress: Progress | None = None, workers: int = 1) -> Truth:
    """Render the recording of a spec into ``folder`` and return its true values.

    More than one of the ``workers`` render in separate processes with the same result. Raises :class:`OutputExists` if
    there is anything in the folder, or :class:`OutputNotWritable`.
    """
    recording = SimulatedRecording(spec)
    is_new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            raise OutputExists(folder)
        for name in ("rgb", "depth"):
            (folder / name).mkdir()
    except FileExistsError as cause:
        raise OutputExists(folder) from cause
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    try:
        return _write_recording(recording, folder, progress, workers)
    except BaseException:
        # Remove an incomplete recording, so that the next try finds the folder free.
        shutil.rmtree(folder, ignore_errors=True)
        if not is_new:
            folder.mkdir(exist_ok=True)
        raise


def _write_recording(recording: SimulatedRecording, folder: Path, progress: Progress | None, workers: int) -> Truth:
    """Write everything; the lists that make it a recording last."""
    truth = recording.truth
    count = len(recording)
    visible = np.empty_like(truth.visible_share)
    with _render_frames(recording, folder, workers) as rendered:
        for i, share in enumerate(rendered):
            visible[i] = share
            if progress is not None:
                progress(i + 1, count)
    files = [_image_names(recording, i) for i in range(count)]
    lists = {kind: [f"{Path(names[kind]).stem} {names[kind]}" for names in files] for kind in ("rgb", "depth")}
    truth = dataclasses.replace(truth, visible_share=visible)
    write_camera_info(folder / CAMERA_FILE, truth.camera, registered=True, mirrored=False)
    clicks = sample_clicks(truth)
    try:
        write_clicks(folder / CLICKS_FILE, clicks)
        write_truth(folder / TRUTH_FILE, truth, clicks)
        for kind, title, name in (("rgb", "color images", COLOR_LIST), ("depth", "depth maps", DEPTH_LIST)):
            text = "\n".join([f"# {title}", SIMULATED_REMARK, "# timestamp filename", *lists[kind], ""])
            (folder / name).write_text(text, encoding="utf-8")
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    return truth


def _cache_folder() -> Path:
    return Path(platformdirs.user_cache_dir("carpus", appauthor=False)) / "simulated"


def is_cached(spec: RecordingSpec, cache: Path | None = None) -> bool:
    """Return whether the recording of a spec is in the cache."""
    return ((_cache_folder() if cache is None else cache) / spec.cache_key / TRUTH_FILE).exists()


def render_cached(
    spec: RecordingSpec, progress: Progress | None = None, cache: Path | None = None, workers: int = 1
) -> Path:
    """Return the folder of a spec's recording, rendered if it is not in the cache."""
    root = _cache_folder() if cache is None else cache
    folder = root / spec.cache_key
    if is_cached(spec, root):
        return folder
    root.mkdir(parents=True, exist_ok=True)
    part = Path(tempfile.mkdtemp(prefix=f"{spec.cache_key}.", dir=root))
    try:
        simulate(spec, part, progress, workers)
        try:
            part.rename(folder)
        except OSError:
            # Another process finished the same recording meanwhile.
            if not (folder / TRUTH_FILE).exists():
                raise
    finally:
        shutil.rmtree(part, ignore_errors=True)
    return folder


@contextlib.contextmanager
def _render_frames(recording: SimulatedRecording, folder: Path, workers: int) -> Iterator[Iterator[FloatArray]]:
    """Render and write every frame; yields the visible shares in order."""
    pool = _create_worker_pool(recording.spec, folder, workers) if workers > 1 else None
    if pool is not None:
        with pool as processes:
            try:
                yield processes.map(_render_in_worker, range(len(recording)), chunksize=4)
            finally:
                processes.shutdown(cancel_futures=True)
    else:
        with ThreadPoolExecutor(2) as threads:
            yield _render_ahead(recording, folder, threads)


def _create_worker_pool(spec: RecordingSpec, folder: Path, workers: int) -> ProcessPoolExecutor | None:
    """Create rendering processes; None if they cannot share memory (a container without /dev/shm)."""
    context = multiprocessing.get_context("spawn")
    try:
        return ProcessPoolExecutor(workers, context, initializer=_init_worker, initargs=(spec, folder))
    except (OSError, NotImplementedError):
        return None


def _render_ahead(recording: SimulatedRecording, folder: Path, pool: ThreadPoolExecutor) -> Iterator[FloatArray]:
    """Render the next frame while noise is added to those before."""
    waiting: list[Future[None]] = []
    for i in range(len(recording)):
        clean = recording.render_clean(i)
        waiting.append(pool.submit(_write_images, recording, i, clean, folder))
        if len(waiting) > 4:
            waiting.pop(0).result()
        yield clean.visible_share
    for future in waiting:
        future.result()


_WORKER_STATE: list[tuple[SimulatedRecording, Path]] = []
"""Recording and folder of a rendering process; empty everywhere else."""


def _init_worker(spec: RecordingSpec, folder: Path) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C reaches all processes: the parent stops them
    _WORKER_STATE.append((SimulatedRecording(spec), folder))


def _render_in_worker(i: int) -> FloatArray:
    recording, folder = _WORKER_STATE[0]
    clean = recording.render_clean(i)
    _write_images(recording, i, clean, folder)
    return clean.visible_share


def _image_names(recording: SimulatedRecording, i: int) -> dict[str, str]:
    """Return the file names of a frame's images inside the folder."""
    depth_s = RECORDING_EPOCH_S + recording.times.depth_s[i]
    return {"rgb": f"rgb/{recording.truth.timestamp_s[i]:.6f}.png", "depth": f"depth/{depth_s:.6f}.png"}


def _write_images(recording: SimulatedRecording, i: int, clean: CleanImage, folder: Path) -> None:
    color, depth = recording.apply_sensor(i, clean)
    files = _image_names(recording, i)
    for kind, image in (("rgb", cv2.cvtColor(color, cv2.COLOR_RGB2BGR)), ("depth", depth)):
        path = folder / files[kind]
        is_coded, data = cv2.imencode(".png", image, _PNG_LEVEL)
        if not is_coded:
            raise OutputNotWritable(path, "picture cannot be coded")
        try:
            path.write_bytes(data.tobytes())
        except OSError as cause:
            raise write_fault(path, cause) from cause


class SimulatedSource:
    """Frame source of the first ``seconds`` of a recording, with the same frames."""

    def __init__(self, spec: RecordingSpec, seconds: float) -> None:
        self._recording = SimulatedRecording(spec)
        self._count = int((self._recording.times.color_s < seconds).sum())
        camera = self._recording.truth.camera
        self.info = SourceInfo(spec.cache_key, camera, True, self._count, spec.fps, {SIMULATED: "yes"})

    def frames(self) -> Iterator[Frame]:
        return islice(self._recording.frames(), self._count)

    def close(self) -> None:
        """Nothing to close."""
