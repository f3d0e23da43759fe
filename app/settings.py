"""All that a person may choose, gathered: frozen sections read from TOML over the shipped defaults.

Each section is declared beside the code it configures; an unknown key or a value of the wrong kind is
:class:`SettingsInvalid` and names the key.
"""

from __future__ import annotations

import json
import logging
import os
import tomllib
import typing
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, is_dataclass, replace
from functools import cached_property
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar
from urllib.parse import urlsplit

import platformdirs

from carpus.core.model.errors import CarpusFault, SettingsInvalid
from carpus.core.model.phrase import phrase
from carpus.core.model.setting_values import NOT_IN_FILE, convert_value, expand_home, settable_names
from carpus.core.pipeline.live_values import LiveSettings, StartMode
from carpus.core.platform.durable import replace_text, write_fault
from carpus.core.records.values import BackupSettings
from carpus.core.results.report_form import ReportSettings
from carpus.core.session.values import ANGLE_ORDERS as ANGLE_ORDERS

if TYPE_CHECKING:
    from carpus.core.pipeline.track import TrackSettings

SETTINGS_FILE, PREFERENCES_FILE = "settings.toml", "preferences.toml"
"""The first is written by people, the second by the window; the second goes over the first."""
LAST_FOLDER_FILE = "last-data-folder.txt"

TRACKING = ("detection", "calibration", "tracker")
"""Sections that decide how pictures become a session."""
DATA_VARIABLE = "CARPUS_DATA"
OBSOLETE = {
    *(
        f"live.{name}"
        for name in (
            "moved_stall_s", "told_stall_s", "recent_frames", "history_s", "row_bytes", "picture_bytes",
            "stop_patience_s",
        )
    ),
    "live.folder",
    "report.agreement_limit_deg",
    "report.retest_days",
    "screen.keys",
    *(
        f"calibration.{name}"
        for name in (
            "still_px", "enough_frames", "pixel_sd_px", "pixel_stays_px", "same_disc_px", "least_discs",
            "most_length_change", "candidates", "naming", "finger_order", "palm_names", "side", "odd_disc",
            "registration", "back",
        )
    ),
    *(
        f"tracker.{name}"
        for name in (
            "holding", "finding", "readout", "doubt", "said", "shape_news", "shape_stale", "mode_dwell_s",
            "unseen_scale", "rate_memory_s", "profiles", "shape_hidden", "mode_scales", "spread", "initial", "noise",
            "association", "fingers", "tissue", "use_surface", "surface", "marker_radius_m",
        )
    ),
    *(
        f"detection.{name}"
        for name in (
            "small_radius_m", "paper_share", "darkest", "least_similarity", "region_sd", "depth_valid_share",
            "depth_iqr_m", "slope_share", "edge_step_m", "edge_sd_m", "fewest_readings", "paper_low", "paper_high",
            "fewest_rim", "fewest_core", "click_reach", "paper_reach", "learning_rounds", "fallback_radius_px",
            "coarse", "skin_level", "paper_level", "usual_depth_m", "most_unsure_px", "stencil", "touching", "sampling",
        )
    ),
}  # fmt: skip
"""Settings of earlier versions, and whole tables of them: accepted and ignored."""

logger = logging.getLogger(__name__)
T = TypeVar("T")
Values = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class ScreenSettings:
    """``theme`` of the window; ``text_scale`` 1, 1.25 or 1.5; ``language`` a code of two letters, or the
    computer's; ``research``: whether what only research needs is shown."""

    theme: Literal["light", "dark", "system"] = "system"
    text_scale: float = 1.0
    language: str = "system"
    research: bool = False

    def __post_init__(self) -> None:
        if not 0.5 <= self.text_scale <= 4.0:
            raise ValueError(f"text_scale {self.text_scale} is not between 0.5 and 4")


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """``uri`` of one of several cameras; ``intrinsics`` a ROS camera file measured for it; both may be empty."""

    uri: str = ""
    intrinsics: str = ""


@dataclass(frozen=True, slots=True)
class RecordingSettings:
    """``folder`` of patients and sessions, empty for the user's own; ``keep_pictures`` pictures of the hand with
    each session where the disk has room; ``smooth`` each session when it is stored; ``start``: at the key, counted down
    after it, or by itself over a hand that lies still."""

    folder: str = ""
    keep_pictures: bool = True
    smooth: bool = True
    start: StartMode = "key"


def _is_server_url(text: str) -> bool:
    try:
        parts = urlsplit(text)
        return parts.scheme in ("postgresql", "postgres") and "://" in text and parts.port != 0
    except ValueError:  # a port that is no number, a bracket that is not closed
        return False


@dataclass(frozen=True, slots=True)
class RecordsSettings:
    """``retention_years`` for which records must be kept, 0 for not set: laws differ. ``url`` of a clinic's PostgreSQL
    (``postgresql://user@host/carpus``), empty for this computer alone; ``sessions`` a folder that all its computers
    share, empty for the data folder's own."""

    retention_years: int = 0
    url: str = ""
    sessions: str = ""

    def __post_init__(self) -> None:
        if not 0 <= self.retention_years <= 100:
            raise ValueError(f"retention_years {self.retention_years} is not between 0 and 100")
        if self.url and not _is_server_url(self.url):
            raise ValueError("url is not one of a PostgreSQL server, such as postgresql://user@host/carpus")


@dataclass(frozen=True, slots=True)
class LockSettings:
    """``after_min`` minutes without a key the window locks, where there is a PIN; 0 for never."""

    after_min: int = 10

    def __post_init__(self) -> None:
        if not 0 <= self.after_min <= 600:
            raise ValueError(f"after_min {self.after_min} is not between 0 and 600")


@dataclass(frozen=True, slots=True)
class StreamSettings:
    """``on``: live angles, places and events go out over Lab Streaming Layer, which anybody in the network can read."""

    on: bool = False


@dataclass(frozen=True, slots=True)
class PatientSettings:
    """``sound``: the patient's view beeps once whenever a goal is reached."""

    sound: bool = False


@dataclass(frozen=True, slots=True)
class UpdatesSettings:
    """``folder`` in which the clinic lays packages of Carpus, as ``make release`` makes it; empty: nobody looks."""

    folder: str = ""


@dataclass(frozen=True, slots=True)
class WelcomeSettings:
    """``answered``: what the first start offers was taken up or declined, and is not offered again."""

    answered: bool = False


@dataclass(frozen=True)
class Settings:
    """Everything, one section each."""

    screen: ScreenSettings = field(default_factory=ScreenSettings)
    camera: CameraSettings = field(default_factory=CameraSettings)
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    report: ReportSettings = field(default_factory=ReportSettings)
    backup: BackupSettings = field(default_factory=BackupSettings)
    records: RecordsSettings = field(default_factory=RecordsSettings)
    lock: LockSettings = field(default_factory=LockSettings)
    stream: StreamSettings = field(default_factory=StreamSettings)
    patient: PatientSettings = field(default_factory=PatientSettings)
    updates: UpdatesSettings = field(default_factory=UpdatesSettings)
    first_start: WelcomeSettings = field(default_factory=WelcomeSettings)
    live: LiveSettings = field(default_factory=LiveSettings)
    tracking: Mapping[str, Values] = field(default_factory=dict, metadata=NOT_IN_FILE)
    """What a person's file says in the sections of :data:`TRACKING`."""
    run_folder: Path | None = field(default=None, metadata=NOT_IN_FILE)
    """The data folder that was named for this run alone."""

    @cached_property
    def track(self) -> TrackSettings:
        """What decides how pictures become a session. All that tracks is loaded with it: a window that starts does not
        wait for that."""
        from carpus.core.pipeline.track import TrackSettings

        return replace(_build_section(TrackSettings, self.tracking, "", SETTINGS_FILE), smooth=self.recording.smooth)

    @property
    def data_folder(self) -> Path:
        """Where patients and sessions are: as named for this run, else by ``CARPUS_DATA``, else by the setting."""
        if self.run_folder is not None:
            return self.run_folder
        named = os.environ.get(DATA_VARIABLE) or self.recording.folder
        return expand_home(named) if named else default_data_folder()


def default_data_folder() -> Path:
    """Where patients and sessions belong on this system."""
    return Path(platformdirs.user_data_dir("carpus", appauthor=False))


def sessions_folder(settings: Settings) -> Path | None:
    """The shared folder of the sessions; None for the data folder's own."""
    return expand_home(settings.records.sessions) if settings.records.sessions else None


def settings_folder() -> Path:
    """Where this person's settings are."""
    return Path(platformdirs.user_config_dir("carpus", appauthor=False))


def load_settings(folder: Path | None = None) -> Settings:
    """The shipped defaults with this person's settings and what was chosen in the window over them."""
    settings, faults = load_valid_settings(folder)
    for fault in faults:
        raise fault
    return settings


def load_valid_settings(folder: Path | None = None) -> tuple[Settings, list[CarpusFault]]:
    """For the window, which starts whatever a file holds: one that cannot be used is left out, and its fault told."""
    folder = folder or settings_folder()
    merged = _load_defaults()
    faults: list[CarpusFault] = []
    for name in (SETTINGS_FILE, PREFERENCES_FILE):
        try:
            merged = _merge(merged, _read_own_settings(folder / name))
        except CarpusFault as fault:
            faults.append(fault)
    return _build_settings(merged, "defaults.toml"), faults


def _load_defaults() -> Values:
    """The shipped file, but for what the code says itself when it tracks."""
    shipped = _parse_toml("defaults.toml", (resources.files("carpus.resources") / "defaults.toml").read_bytes())
    return {name: section for name, section in shipped.items() if name not in TRACKING}


def _build_settings(values: Values, file: str) -> Settings:
    """All sections; what a person says of tracking is looked at now, so that its fault is told now."""
    tracking = {name: values[name] for name in TRACKING if values.get(name)}
    if tracking:
        from carpus.core.pipeline.track import TrackSettings

        _build_section(TrackSettings, tracking, "", file)
    others = {name: value for name, value in values.items() if name not in TRACKING}
    return replace(_build_section(Settings, others, "", file), tracking=tracking)


def _read_own_settings(path: Path) -> Values:
    """What a person's file says, sound as far as it goes; nothing where there is no file."""
    try:
        own = _drop_obsolete(_parse_toml(str(path), path.read_bytes()), path) if path.exists() else {}
    except OSError as cause:
        raise SettingsInvalid(path, cause.strerror or phrase("cannot be read")) from cause
    _build_settings(own, str(path))  # faults name the file they are in
    return own


def _drop_obsolete(values: Values, path: Path, where: str = "") -> Values:
    """Drop settings of earlier versions, with a line in the log."""
    kept: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}{name}"
        if place in OBSOLETE:
            logger.info("The setting %s in %s is not used any more", place, path)
        elif not isinstance(value, Mapping):
            kept[name] = value
        elif (inner := _drop_obsolete(value, path, f"{place}.")) or not value:
            kept[name] = inner
    return kept


_PREFERENCE_FIELDS = {
    "screen": ("theme", "text_scale", "language", "research"),
    "recording": ("folder",),
    "report": ("therapist", "angle_order"),
    "backup": ("folder", "hour"),
    "records": ("retention_years",),
    "lock": ("after_min",),
    "stream": ("on",),
    "patient": ("sound",),
    "first_start": ("answered",),
}


def save_preferences(before: Settings, chosen: Settings, folder: Path | None = None) -> None:
    """Store what a person has changed in the window, and nothing else.

    What was named for one run, or stands in the person's own file, is no choice made in the window. Raises
    :class:`OutputNotWritable`, :class:`DiskFull`.
    """
    path = (folder or settings_folder()) / PREFERENCES_FILE
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        kept = _read_preferences(path)
    except OSError as cause:
        raise write_fault(path, cause) from cause
    for section, names in _PREFERENCE_FIELDS.items():
        for name in names:
            value = getattr(getattr(chosen, section), name)
            if value != getattr(getattr(before, section), name):
                kept.setdefault(section, {})[name] = value
    lines = ["# Chosen in the window of Carpus."]
    for section, values in kept.items():
        lines += [f"[{section}]", *(f"{name} = {_format_value(value)}" for name, value in values.items())]
    replace_text(path, "\n".join([*lines, ""]))


def _read_preferences(path: Path) -> dict[str, dict[str, Any]]:
    """What a file of preferences says; one that cannot be used is kept under another name."""
    try:
        return {section: dict(values) for section, values in _read_own_settings(path).items()}
    except SettingsInvalid:
        path.replace(path.with_name(f"{path.stem}.unusable{path.suffix}"))
        return {}


def save_last_data_folder(data_folder: Path, folder: Path | None = None) -> Path | None:
    """Remember the data folder that a window opens; the one of the start before, where that was another."""
    path = (folder or settings_folder()) / LAST_FOLDER_FILE
    before = ""
    with suppress(OSError, UnicodeError):
        before = path.read_text(encoding="utf-8")
    if before != str(data_folder):
        with suppress(OSError, CarpusFault):
            path.parent.mkdir(parents=True, exist_ok=True)
            replace_text(path, str(data_folder))
    return Path(before) if before not in ("", str(data_folder)) else None


def _format_value(value: object) -> str:
    """As TOML writes it, which writes texts, numbers and truths as JSON does."""
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{name} = {_format_value(one)}' for name, one in sorted(value.items()))}}}"
    return json.dumps(value, ensure_ascii=False)


def _parse_toml(name: str, data: bytes) -> Values:
    try:
        return tomllib.loads(data.decode("utf-8"))
    except RecursionError as cause:
        raise SettingsInvalid(name, phrase("not TOML: tables within tables without end")) from cause
    except ValueError as cause:  # TOML's own faults, text that is none, numbers without end
        raise SettingsInvalid(name, f"not TOML: {cause}"[:200]) from cause


def _merge(below: Values, above: Values) -> Values:
    out = dict(below)
    for name, value in above.items():
        both = isinstance(value, Mapping) and isinstance(out.get(name), Mapping)
        out[name] = _merge(out[name], value) if both else value
    return out


def _build_section(kind: type[T], values: Values, where: str, file: str) -> T:
    """A dataclass from a table; every key must be one of its fields, but for those that no file has."""
    hints = typing.get_type_hints(kind)
    known = settable_names(kind)
    found: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}.{name}" if where else name
        if name not in known:
            raise SettingsInvalid(place, phrase("there is no such setting, in {file}", file=file))
        hint = hints[name]
        is_section = isinstance(hint, type) and is_dataclass(hint) and isinstance(value, Mapping)
        found[name] = (
            _build_section(hint, value, place, file) if is_section else convert_value(hint, value, place, file)
        )
    try:
        return kind(**found)
    except ValueError as cause:
        raise SettingsInvalid(where, f"{cause}, in {file}") from cause


def with_data_folder(settings: Settings, folder: Path | None) -> Settings:
    """The settings with the data folder named on the command line: without the clinic's server, shared folder and daily
    backup, which are those of its own data folder."""
    if folder is None or folder.absolute() == settings.data_folder.absolute():
        return settings
    records, backup = replace(settings.records, url="", sessions=""), replace(settings.backup, hour=-1)
    return replace(settings, run_folder=folder, records=records, backup=backup)


def with_saved_folder(settings: Settings, folder: Path) -> Settings:
    """The settings with another data folder; also from the next start on, unless this run had a folder of its own."""
    if settings.run_folder is not None:
        return replace(settings, run_folder=folder)
    os.environ.pop(DATA_VARIABLE, None)  # it would go over what was just chosen
    chosen = replace(settings, recording=replace(settings.recording, folder=str(folder)))
    with suppress(CarpusFault):
        save_preferences(settings, chosen)
    return chosen
