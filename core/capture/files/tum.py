"""A recording as a TUM RGB-D folder, read and written."""

from __future__ import annotations

import errno
import math
import os
import shutil
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from io import FileIO
from pathlib import Path, PurePath, PureWindowsPath

import numpy as np

from carpus.core.capture.camera_info import CAMERA_FILE, CameraInfo, read_camera_info, rescale_camera, write_camera_info
from carpus.core.capture.files.image_codec import encode_color, encode_depth, read_color, read_depth
from carpus.core.capture.source import NoticeHandler, SourceInfo, ignore_notice, is_simulated
from carpus.core.model import errors
from carpus.core.model.camera import DEFAULT_CAMERA, Camera
from carpus.core.model.errors import CarpusFault
from carpus.core.model.phrase import phrase
from carpus.core.model.types import SIMULATED, DepthImage, FloatArray, Frame
from carpus.core.platform.durable import FileWriter, open_private, write_fault

COLOR_LIST = "rgb.txt"
DEPTH_LIST = "depth.txt"
DEPTH_UNIT_M = 1.0 / 5000.0
_MILLIMETRE_M = 1e-3
_TIME_UNITS = ((2e6, 1e-9, "ns"), (2e3, 1e-6, "µs"), (2.0, 1e-3, "ms"))
"""Unit of the times by the median step between two images: no camera takes so long in seconds."""
_MIN_DISTANCE_SHARE = 0.5
"""Share of the sensor's nearest distance: if half of the readings are nearer, the depth unit is another."""
_UNIT_SAMPLE_FRAMES = 5
"""Depth images used to find the unit."""
PAIRING_LIMIT_S = 0.020
_TIME_ROUNDING_S = 1e-6
"""The lists give microseconds; two times 20 ms apart may differ by a little more in floating point."""
SIMULATED_REMARK = "# simulated by Carpus"
"""Comment line in the lists of a simulated recording."""
RECORDED_REMARK, RECORDING_ID_REMARK = "# carpus recorded ", "# carpus recording_id "
"""Such lines say when the hand moved and which recording it is."""
_Entry = tuple[float, Path, str]
"""Time, image file and its place in the list."""
_DecodedFrame = tuple[Frame | None, bool]
_READING_THREADS, _READ_AHEAD = 2, 8
_FPS_OF_ONE_PICTURE = 30.0


@dataclass(frozen=True, slots=True)
class StoredFrame:
    """Colour image of the list, the nearest depth image, and the frames missing before it."""

    timestamp_s: float
    color: Path
    depth: Path | None
    dropped_before: int


class TumFolder:
    """TUM RGB-D folder as a :class:`core.capture.source.FrameSource`.

    Opening reads the lists, checks that all images exist, and decodes the first; the others are decoded as they come.

    With ``requires_depth`` a folder without usable depth is a fault. With ``skip_damaged`` missing or damaged images
    (but the first colour image) are skipped and notified by :class:`DamagedFramesExcluded`.
    """

    def __init__(
        self,
        folder: Path,
        *,
        requires_depth: bool = True,
        skip_damaged: bool = False,
        notice: NoticeHandler = ignore_notice,
    ) -> None:
        if not folder.exists():
            raise errors.RecordingMissing(folder)
        if not folder.is_dir():
            raise errors.RecordingUnreadable(folder, phrase("not a folder"))
        self._folder, self._skip_damaged, self._notice = folder, skip_damaged, notice
        color, color_gone = _check_files(_read_list(folder / COLOR_LIST, notice), skip_damaged, first=True)
        if not color:
            raise errors.RecordingEmpty(folder, phrase("no frame in {color_list}", color_list=COLOR_LIST))
        depth_list = folder / DEPTH_LIST
        depth_entries = _read_list(depth_list, notice) if depth_list.exists() else []
        if requires_depth and not depth_entries:
            missing = phrase("no frame in {depth_list}", depth_list=DEPTH_LIST)
            raise errors.DepthMissing(folder, missing if depth_list.exists() else f"no {DEPTH_LIST}")
        depth, depth_gone = _check_files(depth_entries, skip_damaged, first=False)
        if color_gone or depth_gone:
            notice(errors.DamagedFramesExcluded(folder, _format_counts(color_gone, depth_gone, "missing")))
        color_s = np.array([time_s for time_s, _ in color])
        partner = pair_by_time(color_s, np.array([time_s for time_s, _ in depth]))
        if requires_depth and not any(index is not None for index in partner):
            limit = f"{PAIRING_LIMIT_S * 1000.0:.0f}"
            detail = phrase("no depth frame within {pairing_limit_s} ms of a colour frame", pairing_limit_s=limit)
            raise errors.DepthMissing(folder, detail)
        self.stored_frames = tuple(
            StoredFrame(time_s, path, None if index is None else depth[index][1], dropped)
            for (time_s, path), index, dropped in zip(color, partner, count_dropped_frames(color_s), strict=True)
        )
        try:
            first = read_color(self.stored_frames[0].color)
        except errors.FrameDamaged as fault:
            raise errors.InitialFrameDamaged(fault.subject, fault.detail) from fault
        self._size = (first.shape[1], first.shape[0])
        camera_info = _load_camera(folder, *self._size)
        self._depth_unit_m = camera_info.depth_unit_m or _estimate_depth_unit_m(
            folder, self.stored_frames, camera_info.camera, notice
        )
        with (folder / COLOR_LIST).open(encoding="utf-8-sig") as lines:
            remarks = [line.strip() for line in lines if line.startswith("#")]

        def read_remark(start: str) -> str:
            return next((line.removeprefix(start) for line in remarks if line.startswith(start)), "")

        self.info = SourceInfo(
            name=folder.resolve().name,
            camera=camera_info.camera,
            has_depth=any(frame.depth is not None for frame in self.stored_frames),
            frame_count=len(self.stored_frames),
            nominal_fps=1.0 / float(np.median(np.diff(color_s))) if len(color) > 1 else _FPS_OF_ONE_PICTURE,
            settings={
                "format": "tum",
                "depth_unit_m": repr(self._depth_unit_m),
                **({SIMULATED: "yes"} if SIMULATED_REMARK in remarks else {}),
            },
            recording_id=read_remark(RECORDING_ID_REMARK),
            recorded=read_remark(RECORDED_REMARK),
        )

    def frames(self) -> Iterator[Frame]:
        """Yield the frames in order, numbered; may be repeated. Skipped ones count as missing before the next."""
        number, color_lost, depth_lost, missing = 0, 0, 0, 0
        with closing(self._prefetch_frames()) as decoded:
            for frame, depth_is_lost in decoded:
                depth_lost += depth_is_lost
                if frame is None:
                    color_lost += 1
                    missing += 1 + self.stored_frames[number + color_lost - 1].dropped_before
                    continue
                yield replace(frame, index=number, dropped_before=frame.dropped_before + missing)
                number, missing = number + 1, 0
        if color_lost or depth_lost:
            self._notice(errors.DamagedFramesExcluded(self._folder, _format_counts(color_lost, depth_lost, "damaged")))

    def close(self) -> None:
        """Do nothing: no file is open between two frames."""

    def _load_frame(self, index: int) -> _DecodedFrame:
        """Return a frame, or None if its colour image is skipped, and whether its depth image was."""
        for with_depth in (True, False):
            try:
                return self._read_frame(index, with_depth=with_depth), not with_depth
            except errors.FrameDamaged:
                if not self._skip_damaged:
                    raise
        return None, False

    def _prefetch_frames(self) -> Generator[_DecodedFrame]:
        """Yield the decoded frames, of which two threads decode some in advance."""
        pending: deque[Future[_DecodedFrame]] = deque()
        with ThreadPoolExecutor(_READING_THREADS, thread_name_prefix="read-ahead") as pool:
            try:
                for index in range(len(self.stored_frames)):
                    pending.append(pool.submit(self._load_frame, index))
                    if len(pending) > _READ_AHEAD:
                        yield pending.popleft().result()
                while pending:
                    yield pending.popleft().result()
            finally:
                for future in pending:
                    future.cancel()

    def _read_frame(self, index: int, *, with_depth: bool) -> Frame:
        stored = self.stored_frames[index]
        color = read_color(stored.color)
        self._check_size(stored.color, color.shape)
        depth = None
        if stored.depth is not None and with_depth:
            depth = read_depth(stored.depth)
            self._check_size(stored.depth, depth.shape)
        return Frame(index, stored.timestamp_s, color, depth, self._depth_unit_m, stored.dropped_before)

    def _check_size(self, path: Path, shape: tuple[int, ...]) -> None:
        width, height = self._size
        if shape[:2] != (height, width):
            sizes = {"shape": shape[1], "shape2": shape[0], "width": width, "height": height}
            raise errors.FrameSizeChanged(path, phrase("{shape} x {shape2} pixels, {width} x {height} before", **sizes))


def pair_by_time(color_s: FloatArray, depth_s: FloatArray) -> list[int | None]:
    """Return for each colour time the index of its depth image: nearest pairs first, each used once.

    Both lists rise strictly; pairs more than 20 ms apart are not made.

    >>> pair_by_time(np.array([0.0, 0.033]), np.array([0.004, 0.036]))
    [0, 1]
    """
    limit_s = PAIRING_LIMIT_S + _TIME_ROUNDING_S
    begin = np.searchsorted(depth_s, color_s - limit_s, side="left")
    end = np.searchsorted(depth_s, color_s + limit_s, side="right")
    candidates = sorted(
        (abs(float(depth_s[d] - color_s[c])), c, d) for c in range(len(color_s)) for d in range(begin[c], end[c])
    )
    partner: list[int | None] = [None] * len(color_s)
    used: set[int] = set()
    for _, c, d in candidates:
        if partner[c] is None and d not in used:
            partner[c] = d
            used.add(d)
    return partner


def count_dropped_frames(timestamp_s: FloatArray) -> list[int]:
    """Return the frames missing before each one: a gap of about n median periods lacks n - 1.

    >>> count_dropped_frames(np.array([0.0, 0.033, 0.066, 0.165, 0.198]))
    [0, 0, 0, 2, 0]
    """
    if len(timestamp_s) < 2:
        return [0] * len(timestamp_s)
    gap_s = np.diff(timestamp_s)
    return [0, *(max(0, round(float(gap)) - 1) for gap in gap_s / np.median(gap_s))]


def _estimate_depth_unit_m(folder: Path, stored: Sequence[StoredFrame], camera: Camera, notice: NoticeHandler) -> float:
    """Return metres per count: the format's 1/5000, or 1 mm if half of the readings would be far too near."""
    for frame in [frame for frame in stored if frame.depth is not None][:_UNIT_SAMPLE_FRAMES]:
        assert frame.depth is not None
        try:
            counts = read_depth(frame.depth)
        except errors.FrameDamaged:  # reported when it is read
            continue
        if (counts > 0).any():
            middle, nearest_m = float(np.median(counts[counts > 0])), camera.sensor.nearest_m
            if middle * DEPTH_UNIT_M >= _MIN_DISTANCE_SHARE * nearest_m or middle * _MILLIMETRE_M < nearest_m:
                return DEPTH_UNIT_M
            notice(errors.UnitAssumed(folder, phrase("depth in millimetres, not 5000 per metre")))
            return _MILLIMETRE_M
    return DEPTH_UNIT_M


def _read_list(path: Path, notice: NoticeHandler) -> list[_Entry]:
    """Return times, image files and lines of ``rgb.txt`` or ``depth.txt``; the times must rise.

    Times in another unit are notified; lines with the time of the line before are skipped and notified.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as cause:
        raise errors.RecordingUnreadable(path, phrase("missing")) from cause
    except OSError as cause:
        raise errors.RecordingUnreadable(path, cause.strerror or phrase("cannot be opened")) from cause
    except UnicodeDecodeError as cause:
        raise errors.RecordingUnreadable(path, phrase("not a text file")) from cause
    entries: list[_Entry] = []
    repeated = 0
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.strip()
        if not content or content.startswith("#"):
            continue
        time_s, picture = _parse_entry(path, number, content)
        if entries and time_s == entries[-1][0]:
            repeated += 1
            continue
        if entries and time_s < entries[-1][0]:
            times = {"time_s": f"{time_s:.6f}", "earlier": f"{entries[-1][0]:.6f}"}
            detail = phrase("line {number}: {time_s} s after {earlier} s", number=number, **times)
            raise errors.TimesUnordered(path, detail)
        entries.append((time_s, picture, f"{path.name} line {number}"))
    if repeated:
        notice(errors.RepeatedTimesExcluded(path, str(repeated)))
    step = float(np.median(np.diff([time_s for time_s, _, _ in entries]))) if len(entries) > 1 else 0.0
    for min_step, scale, unit in _TIME_UNITS:
        if step >= min_step:
            notice(errors.UnitAssumed(path, phrase("times in {unit}, not in seconds", unit=unit)))
            return [(time_s * scale, picture, place) for time_s, picture, place in entries]
    return entries


def _check_files(entries: list[_Entry], skip_damaged: bool, *, first: bool) -> tuple[list[tuple[float, Path]], int]:
    """Return the entries whose files exist, and the number of others; the first colour image must exist."""
    found: list[tuple[float, Path]] = []
    for time_s, picture, place in entries:
        if os.path.isfile(picture):  # noqa: PTH113  # and no name is too long
            found.append((time_s, picture))
        elif first and not found:
            raise errors.InitialFrameDamaged(picture, phrase("missing, {place}", place=place))
        elif not skip_damaged:
            raise errors.FrameDamaged(picture, phrase("missing, {place}", place=place))
    return found, len(entries) - len(found)


def _format_counts(color: int, depth: int, how: str) -> str:
    counts = [f"{count} {kind}" for count, kind in ((color, "colour"), (depth, "depth")) if count]
    return f"{' and '.join(counts)} {how}"


def _parse_entry(path: Path, number: int, content: str) -> tuple[float, Path]:
    time_text, *names = content.split(maxsplit=1)
    try:
        time_s = float(time_text)
    except ValueError:
        time_s = math.nan
    line = {"number": number, "content": f"{content[:60]!r}"}
    if not math.isfinite(time_s) or not names:
        detail = phrase("line {number} is not a time and a file name: {content}", **line)
        raise errors.RecordingUnreadable(path, detail)
    on_windows = PureWindowsPath(names[0])
    inside = PurePath(on_windows.as_posix())
    if inside.is_absolute() or on_windows.drive or on_windows.root or ".." in inside.parts or "\0" in names[0]:
        detail = phrase("line {number} names a file outside the folder: {content}", **line)
        raise errors.RecordingUnreadable(path, detail)
    return time_s, path.parent / inside


def _load_camera(folder: Path, width_px: int, height_px: int) -> CameraInfo:
    path = folder / CAMERA_FILE
    size = f"{width_px} x {height_px} pixels"
    if not path.exists():
        camera = rescale_camera(DEFAULT_CAMERA, (width_px, height_px))
        if camera is None:
            detail = phrase("missing, and there is no default camera for frames of {size}", size=size)
            raise errors.CameraFileUnreadable(path, detail)
        return CameraInfo(camera)
    info = read_camera_info(path)
    camera = info.camera
    if (camera.width_px, camera.height_px) != (width_px, height_px):
        expected = {"width_px": camera.width_px, "height_px": camera.height_px, "size": size}
        detail = phrase("for {width_px} x {height_px} pixels, the frames have {size}", **expected)
        raise errors.CameraFileUnreadable(path, detail)
    if info.mirrored or info.registered is False:
        wrong = "mirrored: true" if info.mirrored else "registered: false"
        raise errors.CameraFileUnreadable(path, phrase("{wrong}, not supported for an image folder", wrong=wrong))
    return info


class TumWriter(FileWriter):
    """Writer of one folder. An image enters its list when its file is complete, so a crash costs one frame."""

    def __init__(self, path: Path, info: SourceInfo) -> None:
        self.path = path
        self._count = 0
        self._lists: dict[str, FileIO] = {}
        try:
            path.mkdir(parents=True)
        except FileExistsError as cause:
            raise errors.OutputExists(path) from cause
        except OSError as cause:
            raise write_fault(path, cause) from cause
        try:
            for name, kind in ((COLOR_LIST, "rgb"), (DEPTH_LIST, "depth")):
                (path / kind).mkdir()
                self._lists[kind] = open(path / name, "xb", 0, opener=open_private)  # noqa: SIM115  # closed by close
                remark = f"{SIMULATED_REMARK}\n" if is_simulated(info) else ""
                remark += f"{RECORDED_REMARK}{info.recorded}\n" if info.recorded else ""
                remark += f"{RECORDING_ID_REMARK}{info.recording_id}\n" if info.recording_id else ""
                _append(self._lists[kind], f"# {kind} pictures of {info.name}\n{remark}# timestamp filename\n")
            write_camera_info(path / CAMERA_FILE, info.camera)
        except OSError as cause:
            self.discard()
            raise write_fault(path, cause) from cause
        except CarpusFault:
            self.discard()
            raise

    def __len__(self) -> int:
        return self._count

    def append_frame(self, frame: Frame) -> None:
        if frame.depth_raw is not None:
            self._store("depth", frame.timestamp_s, encode_depth(to_tum_depth(frame.depth_raw, frame.depth_unit_m)))
        self._store("rgb", frame.timestamp_s, encode_color(frame.color_rgb, lossless=True))
        self._count += 1

    def close(self) -> None:
        """Close the lists; may be called twice."""
        lists, self._lists = self._lists, {}
        for each in lists.values():
            try:
                each.close()
            except OSError as cause:
                raise write_fault(self.path, cause) from cause

    def abandon(self) -> None:
        for each in self._lists.values():
            with suppress(OSError):
                each.close()
        self._lists = {}

    def discard(self) -> None:
        self.abandon()
        shutil.rmtree(self.path, ignore_errors=True)

    def _store(self, kind: str, timestamp_s: float, data: bytes) -> None:
        name = f"{kind}/{timestamp_s:.6f}.png"
        try:
            with open(self.path / name, "wb", opener=open_private) as file:
                file.write(data)
            _append(self._lists[kind], f"{timestamp_s:.6f} {name}\n")
        except OSError as cause:
            with suppress(OSError):
                (self.path / name).unlink()  # it may be torn, and is in no list
            raise write_fault(self.path, cause) from cause


def _append(file: FileIO, text: str) -> None:
    """Append a text completely or not at all; raises OSError."""
    data, begin = text.encode(), file.tell()
    if file.write(data) < len(data):
        file.truncate(begin)
        file.seek(begin)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def to_tum_depth(depth_raw: DepthImage, depth_unit_m: float) -> DepthImage:
    """Return depth in 5000 counts per metre; more than 13.1 m becomes 0 (no reading)."""
    scale = depth_unit_m / DEPTH_UNIT_M
    if abs(scale - 1.0) < 1e-9:
        return depth_raw
    counts = np.rint(depth_raw * scale)
    return np.where(counts > np.iinfo(np.uint16).max, 0, counts).astype(np.uint16)
