"""The functions of ``import carpus`` for researchers: tracking, sessions, simulation; no screen.

import carpus
for frame in carpus.track("recording", "clicks.json"):
    print(frame.time_s, frame.wrist.flexion_deg, frame.wrist.flexion_sd_deg)
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np

from carpus.app.opened_session import OpenedSession, check_path, open_session, show_warning
from carpus.app.session_commands import log_export, read_choices
from carpus.app.sources import open_recording
from carpus.core.calibration.candidates import find_marker_candidates
from carpus.core.calibration.clicks_file import read_clicks, write_clicks
from carpus.core.calibration.label_proposal import propose_labels
from carpus.core.calibration.result import Clicks
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.formats.export import FORMATS, ExportRequest, ExportResult, export_sessions
from carpus.core.formats.output_files import MACHINE_DIALECT
from carpus.core.model.camera import DEFAULT_CAMERA, Camera
from carpus.core.model.errors import CalibrationImpossible, RecordingEmpty, SettingsInvalid
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.hand.protocols import SITES, get_protocol
from carpus.core.model.types import BoolArray, FloatArray, Frame, Side, TrackedFrame, TrackStatus
from carpus.core.pipeline.track import TrackSettings, start_tracking, track_recording
from carpus.core.platform.durable import write_fault
from carpus.core.research.agreement.agreement_files import compare_files
from carpus.core.research.agreement.compare import DEFAULT_MAX_SHIFT_S, MAX_DRIFT_PERCENT, MAX_SHIFT_S, Comparison
from carpus.core.research.agreement.reference import ANGLE_NAMES
from carpus.core.research.papers.hand_model import PaperSettings
from carpus.core.research.papers.tracker import PaperTrackSettings
from carpus.core.simulation import recording
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth
from carpus.core.tracking.filter.settings import Profile, TrackerSettings

FilterName = Literal["default", "paper"]
Dip = Literal["coupled", "free"]


@dataclass(frozen=True, slots=True)
class Wrist:
    """Wrist of one frame; NaN while the hand is lost.

    Angles and their standard deviations are in degrees: + radial, + flexion, + supination on both hands, from the
    palm down (thumb up is + 90).

    Attributes
    ----------
    position_m, rotation_w2_w0, velocity_m_s : ndarray (3,), (3, 3), (3,)
        Pose and velocity of W2 in W0.
    angular_velocity_deg_s : ndarray (3,)
        In W2; NaN with the papers' filter.
    """

    deviation_deg: float
    flexion_deg: float
    pronosupination_deg: float
    deviation_sd_deg: float
    flexion_sd_deg: float
    pronosupination_sd_deg: float
    position_m: FloatArray
    rotation_w2_w0: FloatArray
    velocity_m_s: FloatArray
    angular_velocity_deg_s: FloatArray


@dataclass(frozen=True, slots=True)
class HandFrame:
    """One tracked frame, without smoothing.

    Attributes
    ----------
    time_s : float
        Time as in the recording.
    status : str
        ``tracked``, ``predicted``, ``lost`` or ``doubtful``.
    joint_angles_deg, joint_angles_sd_deg, joint_velocity_deg_s : ndarray (J,)
        In the order of ``joint_names``; empty with six markers.
    marker_position_cam_m : ndarray (M, 3)
        In the axes of the camera, in the order of ``marker_names``.
    marker_measured : ndarray of bool (M,)
        True for markers that were visible.
    """

    time_s: float
    status: str
    wrist: Wrist
    joint_names: tuple[str, ...]
    joint_angles_deg: FloatArray
    joint_angles_sd_deg: FloatArray
    joint_velocity_deg_s: FloatArray
    marker_names: tuple[str, ...]
    marker_position_cam_m: FloatArray
    marker_measured: BoolArray


@dataclass(frozen=True, slots=True)
class ProposedClicks:
    """Proposed markers of a flat hand, for a person to confirm.

    ``markers`` has the pixel [u, v] of each label; ``sure`` is False where another label fits nearly as well.
    """

    hand: Side
    protocol: str
    markers: dict[str, list[float]]
    sure: dict[str, bool]

    @property
    def complete(self) -> bool:
        return len(self.markers) == len(get_protocol(self.protocol).markers)

    def clicks(self) -> Clicks:
        """Return the clicks for the tracker.

        Raises
        ------
        CalibrationImpossible
            A marker was not found.
        """
        protocol = get_protocol(self.protocol)
        lacking = [name for name in protocol.markers if name not in self.markers]
        if lacking:
            raise CalibrationImpossible(f"no disc found for {', '.join(lacking)}")
        return Clicks(self.hand, protocol, np.array([self.markers[name] for name in protocol.markers]))

    def write(self, path: str | Path) -> None:
        """Write the file of clicks. Raises :class:`OutputExists`."""
        write_clicks(Path(path), self.clicks())


def track(
    path: str | Path,
    clicks: str | Path | ProposedClicks,
    *,
    filter: FilterName = "default",
    dip: Dip = "coupled",
    use_depth: bool = True,
    profile: Profile = "standard",
    lost_after_s: float = 1.5,
) -> Iterator[HandFrame]:
    """Track a stored recording and yield its frames as they come.

    Parameters
    ----------
    path : path
        Recording of any kind.
    clicks : path or ProposedClicks
        File of first-frame clicks, or the result of :func:`propose_clicks`.
    filter : {"default", "paper"}
        ``paper`` is the method of the papers, as ``carpus track --filter paper``: colour only, DIP coupled, angles in
        the ZYX order of the hand paper.
    dip : {"coupled", "free"}
        DIP at two thirds of the PIP angle, or measured.
    use_depth : bool
        False for colour only.
    profile : {"standard", "slow", "brisk"}
        How fast the hand moves.
    lost_after_s : float
        Time without three palm markers after which the hand is lost.

    Raises
    ------
    SettingsInvalid
        At once, for a setting with an impossible value.
    CarpusFault
        Says what is wrong with a file (:mod:`core.model.errors`).
    """
    where = "carpus.track"
    chosen = _build_settings(where, filter, dip, use_depth, profile, lost_after_s)
    return _track_frames(check_path(where, "path", path), _load_clicks(where, clicks), replace(chosen, smooth=False))


def write_session(
    path: str | Path,
    clicks: str | Path | ProposedClicks,
    output: str | Path,
    *,
    subject_id: str = "",
    exercise: str = "",
    smooth: bool = True,
    filter: FilterName = "default",
    dip: Dip = "coupled",
    use_depth: bool = True,
    profile: Profile = "standard",
    lost_after_s: float = 1.5,
) -> OpenedSession:
    """Track a stored recording into a new session file, as ``carpus track``, and open it; its folder is made.

    The repetitions of an ``exercise`` are counted: its id, such as ``WRIST_FE``; that of the clicks without it. The
    papers' method has no smoother and ignores ``smooth``. Other parameters as in :func:`track`.
    """
    where = "carpus.write_session"
    _check(where, "smooth", smooth, bool)
    _check(where, "subject_id", subject_id, str)
    _check(where, "exercise", exercise, str)
    if exercise:
        _check(where, "exercise", exercise, Literal[*(known.id for known in EXERCISES)])
    chosen = _build_settings(where, filter, dip, use_depth, profile, lost_after_s)
    recorded, out = check_path(where, "path", path), check_path(where, "output", output)
    told = _load_clicks(where, clicks)
    with closing(open_recording(recorded, need_depth=chosen.uses_depth, notice=show_warning)) as source:
        try:
            out.parent.mkdir(parents=True, exist_ok=True)
        except OSError as cause:
            raise write_fault(out.parent, cause) from cause
        track_recording(
            source, told, out, replace(chosen, smooth=smooth and chosen.smooth),
            subject_id=subject_id, exercise=exercise or told.exercise, path=recorded,
        )  # fmt: skip
    return open_session(out)


def _build_settings(
    where: str, method: str, dip: Dip, use_depth: bool, profile: Profile, lost_after_s: float
) -> TrackSettings:
    """Return checked settings. Raises :class:`SettingsInvalid`."""
    wanted: dict[str, Any] = {"dip": dip, "use_depth": use_depth, "profile": profile, "lost_after_s": lost_after_s}
    _check(where, "filter", method, FilterName)
    known = TrackerSettings()
    _check_fields(where, wanted, TrackerSettings)
    if method == "paper":
        if others := [name for name in wanted if name != "profile" and wanted[name] != getattr(known, name)]:
            raise SettingsInvalid(where, f"the papers' filter knows no {others[0]}")
        return PaperTrackSettings(smooth=False, paper=PaperSettings.from_profile(wanted["profile"]))
    return TrackSettings(tracker=replace(known, **wanted))


def _load_clicks(where: str, clicks: str | Path | ProposedClicks) -> Clicks:
    """Return proposed clicks, or those of a file. Raises :class:`SettingsInvalid` and their faults."""
    return clicks.clicks() if isinstance(clicks, ProposedClicks) else read_clicks(check_path(where, "clicks", clicks))


def _to_list(where: str, name: str, value: object) -> list[Any]:
    """Return the items of a collection, or a single value in a list. Raises :class:`SettingsInvalid`."""
    found = list(value) if isinstance(value, Iterable) and not isinstance(value, (str, bytes)) else [value]
    if not found:
        raise SettingsInvalid(where, f"{name} is empty, one at least expected")
    return found


_TYPE_NAMES: Mapping[Any, str] = {
    float: "a number", int: "a whole number", bool: "True or False", str: "a text",
}  # fmt: skip


def _check_fields(where: str, wanted: Mapping[str, Any], kind: type) -> None:
    """Check values against the fields of a dataclass. Raises :class:`SettingsInvalid`."""
    hints = get_type_hints(kind)
    for name, value in wanted.items():
        if name not in hints:
            raise SettingsInvalid(where, f"it has no setting {name}")
        _check(where, name, value, hints[name])


def _check(
    where: str, name: str, value: object, hint: Any, limits: tuple[float, float] = (-math.inf, math.inf)
) -> None:
    """Check a value against its type and limits. Raises :class:`SettingsInvalid`."""
    if isinstance(hint, UnionType):
        if value is None:
            return
        hint = next(one for one in get_args(hint) if one is not NoneType)
    number = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    expected = _TYPE_NAMES.get(hint, f"a {getattr(hint, '__name__', hint)}")
    if get_origin(hint) is Literal:
        fits, expected = isinstance(value, str) and value in get_args(hint), " or ".join(map(repr, get_args(hint)))
    elif hint is float:
        fits = number
    else:
        fits = type(value) is hint if hint in _TYPE_NAMES else isinstance(value, get_origin(hint) or hint)
    if fits and number and not limits[0] <= float(value) <= limits[1]:  # type: ignore[arg-type]
        fits, expected = False, f"from {limits[0]:g} to {limits[1]:g}"
    if not fits:
        raise SettingsInvalid(where, f"{name} is {value!r}, {expected} expected")
    if isinstance(value, tuple):
        for one in value:
            _check(where, f"one of {name}", one, get_args(hint)[0])


def _check_names(where: str, name: str, value: object, known: Sequence[str]) -> None:
    """Check a mapping from known names to texts. Raises :class:`SettingsInvalid`."""
    if value is None:
        return
    if not isinstance(value, Mapping):
        raise SettingsInvalid(where, f"{name} is {value!r}, a mapping from name to name expected")
    for ours, theirs in value.items():
        _check(where, f"a name in {name}", ours, Literal[*known])
        _check(where, f"{name}[{ours!r}]", theirs, str)


def _check_picture(
    where: str, name: str, value: Any, kind: type, channels: tuple[int, ...], size: tuple[int, ...] = ()
) -> None:
    shape = getattr(value, "shape", ())
    if (
        getattr(value, "dtype", None) != kind
        or shape[2:] != channels
        or len(shape) < 2
        or 0 in shape
        or (size and shape != size)
    ):
        wanted = ", ".join(("H", "W", *map(str, channels))) if not size else "as large as the picture"
        raise SettingsInvalid(where, f"{name} is no recording and no picture ({wanted}) {kind.__name__}")


def _track_frames(path: Path, clicks: Clicks, chosen: TrackSettings) -> Iterator[HandFrame]:
    with closing(open_recording(path, need_depth=chosen.uses_depth, notice=show_warning)) as source:
        begun, names = start_tracking(source, clicks, chosen), clicks.protocol.joint_names(chosen.dip_free)
        for frame in begun.frames:
            yield _hand_frame(begun.pipeline(frame), names, clicks.protocol.markers)


def _hand_frame(found: TrackedFrame, joint_names: Sequence[str], markers: tuple[str, ...]) -> HandFrame:
    moment = found.kinematics
    deviation, flexion, pronosupination = np.degrees(moment.angles_rad).tolist()
    deviation_sd, flexion_sd, pronosupination_sd = np.degrees(moment.angles_sd_rad).tolist()
    return HandFrame(
        found.timestamp_s,
        TrackStatus(found.status).name.lower(),
        Wrist(
            deviation,
            flexion,
            pronosupination,
            deviation_sd,
            flexion_sd,
            pronosupination_sd,
            moment.position_m,
            moment.rotation_w2_w0,
            moment.velocity_m_s,
            np.degrees(moment.angular_velocity_rad_s),
        ),
        tuple(joint_names),
        np.degrees(moment.joint_angles_rad),
        np.degrees(moment.joint_angles_sd_rad),
        np.degrees(moment.joint_velocity_rad_s),
        markers,
        found.marker_position_cam_m,
        np.isfinite(found.marker_measured_px[:, 0]),
    )


def propose_clicks(
    frame: str | Path | Frame | Any,
    hand: Side = "right",
    protocol: str = "wrist6",
    camera: Camera | None = None,
    depth: Any = None,
    depth_unit_m: float = 1e-3,
) -> ProposedClicks:
    """Propose the markers of a flat hand, for a person to confirm.

    ``frame`` is a recording (its first frame is used), a :class:`Frame`, or an RGB image (H, W, 3) of uint8 with its
    ``depth`` (H, W) of uint16 in ``depth_unit_m``. Markers without a likely candidate are absent.
    """
    where = "carpus.propose_clicks"
    _check(where, "hand", hand, Side)
    _check(where, "protocol", protocol, str)
    _check(where, "camera", camera, Camera | None)
    _check(where, "depth_unit_m", depth_unit_m, float, (1e-6, 1.0))
    markers = get_protocol(protocol)
    if isinstance(frame, (str, Path)):
        with closing(open_recording(check_path(where, "frame", frame), need_depth=False)) as source:
            first, camera = next(source.frames(), None), camera or source.info.camera
        if first is None:
            raise RecordingEmpty(frame)
    elif isinstance(frame, Frame):
        first = frame
    else:
        _check_picture(where, "frame", frame, np.uint8, (3,))
        if depth is not None:
            _check_picture(where, "depth", depth, np.uint16, (), frame.shape[:2])
        first = Frame(0, 0.0, frame, depth, depth_unit_m)
    camera = camera or DEFAULT_CAMERA
    blobs = find_marker_candidates(first, camera, DetectionSettings())
    found = propose_labels(blobs, camera, hand, markers)
    named = {
        name: (blobs.pixel[blob].tolist(), bool(sure))
        for name, blob, sure in zip(markers.markers, found.blob.tolist(), found.is_sure, strict=True)
        if blob >= 0
    }
    pixels = {name: pixel for name, (pixel, _) in named.items()}
    return ProposedClicks(hand, protocol, pixels, {name: sure for name, (_, sure) in named.items()})


def export(
    sessions: str | Path | Sequence[str | Path],
    folder: str | Path,
    formats: str | Sequence[str] = ("csv",),
    *,
    deidentified: bool = False,
    region: str | None = None,
) -> ExportResult:
    """Write sessions as csv, json, c3d, trc, mot, bids, fhir or h5; existing files are never overwritten.

    Tables are for programs; with a ``region`` such as ``de_DE`` for a spreadsheet there: its separator, decimal sign
    and a UTF-8 mark. Exports of a data folder are written into its log.

    Returns
    -------
    ExportResult
        Its ``refused`` has what could not be written.

    Raises
    ------
    SettingsInvalid
        Unknown format or region, no format or no session.
    """
    where = "carpus.export"
    _check(where, "deidentified", deidentified, bool)
    paths = [check_path(where, "sessions", path) for path in _to_list(where, "sessions", sessions)]
    wanted = [ExportRequest.from_file(path, read_choices) for path in paths]
    into, chosen = check_path(where, "folder", folder), _to_list(where, "formats", formats)
    for name in chosen:
        _check(where, "formats", name, Literal[*FORMATS])
    from carpus.ui.kit.table_file import regional_table_form  # Qt, which nothing else here loads

    try:
        form = MACHINE_DIALECT if region is None else regional_table_form(region)
    except ValueError as cause:
        raise SettingsInvalid(where, str(cause)) from cause
    done = export_sessions(wanted, into, chosen, deidentified=deidentified, dialect=form)
    log_export(done, deidentified=deidentified)
    return done


def compare(
    session: str | Path,
    reference: str | Path,
    *,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
    most_shift_s: float = DEFAULT_MAX_SHIFT_S,
    lag_s: float | None = None,
    drift_percent: float = 0.0,
) -> Comparison:
    """Compute the agreement of a session with a reference measurement.

    Parameters
    ----------
    session : path
        Session file.
    reference : path
        C3D, TRC, MOT, CSV table, list of readings, or another session.
    columns : mapping
        Angle (or ``time``) to column; a minus before the column changes its sign.
    markers : mapping
        Carpus marker to marker of the reference.
    radians : bool, optional
        Unit of the reference's angles, where it does not say.
    smoothed : bool
        Compare the smoothed results.
    most_shift_s : float
        Largest shift between the two clocks.
    lag_s : float, optional
        Known lag of the reference's clock; no shift is searched.
    drift_percent : float
        How much the reference's clock runs fast.

    Returns
    -------
    Comparison
        Each of ``pairs`` has ``figures_deg``: bias, limits of agreement, rmse, correlation, icc, cmc. Readings
        without a time are compared with the included repetitions.
    """
    where = "carpus.compare"
    _check(where, "smoothed", smoothed, bool)
    _check(where, "radians", radians, bool | None)
    _check_names(where, "columns", columns, ("time", *ANGLE_NAMES))
    _check_names(where, "markers", markers, SITES)
    _check(where, "most_shift_s", most_shift_s, float, (0.0, MAX_SHIFT_S))
    _check(where, "lag_s", lag_s, float | None, (-MAX_SHIFT_S, MAX_SHIFT_S))
    _check(where, "drift_percent", drift_percent, float, (-MAX_DRIFT_PERCENT, MAX_DRIFT_PERCENT))
    ours, theirs = check_path(where, "session", session), check_path(where, "reference", reference)
    result = compare_files(
        ours, theirs, columns=columns, markers=markers, radians=radians, smoothed=smoothed,
        max_shift_s=most_shift_s, lag_s=math.nan if lag_s is None else lag_s, drift=0.01 * drift_percent,
        choices=read_choices(ours),
    )  # fmt: skip
    return result.comparison


def simulate(folder: str | Path, **options: Any) -> Truth:
    """Simulate a recording as a TUM folder with clicks and truth, and return the true values.

    ``options`` are the fields of :class:`core.simulation.spec.RecordingSpec`.
    """
    where = "carpus.simulate"
    _check_fields(where, options, RecordingSpec)
    return recording.simulate(RecordingSpec(**options), check_path(where, "folder", folder))
