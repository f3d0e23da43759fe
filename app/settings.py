"""All settings: frozen sections, read from TOML files over the shipped defaults.

Each section is declared beside the code that it configures. An unknown key or a value of the wrong type raises
:class:`SettingsInvalid` with the key.
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
from carpus.core.model.setting_values import FORMER_NAMES, NOT_IN_FILE, convert_value, expand_home, settable_names
from carpus.core.pipeline.live_values import LiveSettings, StartMode
from carpus.core.platform.durable import replace_text, write_fault
from carpus.core.records.values import BackupSettings
from carpus.core.results.report_form import ReportSettings
from carpus.core.session.values import ANGLE_ORDERS as ANGLE_ORDERS

if TYPE_CHECKING:
    from carpus.core.pipeline.track import TrackSettings

SETTINGS_FILE, PREFERENCES_FILE = "settings.toml", "preferences.toml"
"""Written by people and by the window; the second overrides the first."""

TRACKING = ("detection", "calibration", "tracker")
"""Sections that configure tracking."""
DATA_VARIABLE = "CARPUS_DATA"
OBSOLETE = {"updates"} | {
    f"{section}.{name}"
    for section, names in {
        "live": "folder moved_stall_s told_stall_s recent_frames history_s row_bytes picture_bytes stop_patience_s",
        "report": "agreement_limit_deg retest_days",
        "screen": "keys",
        "calibration": "still_px enough_frames pixel_sd_px pixel_stays_px same_disc_px least_discs most_length_change "
        "candidates naming finger_order palm_names side odd_disc registration back",
        "tracker": "holding finding readout doubt said shape_news shape_stale mode_dwell_s unseen_scale rate_memory_s "
        "profiles shape_hidden mode_scales spread initial noise association fingers tissue use_surface surface "
        "marker_radius_m",
        "detection": "small_radius_m paper_share darkest least_similarity region_sd depth_valid_share depth_iqr_m "
        "slope_share edge_step_m edge_sd_m fewest_readings paper_low paper_high fewest_rim fewest_core click_reach "
        "paper_reach learning_rounds fallback_radius_px coarse skin_level paper_level usual_depth_m most_unsure_px "
        "stencil touching sampling",
    }.items()
    for name in names.split()
}
"""Settings and sections of earlier versions: accepted and ignored."""

logger = logging.getLogger(__name__)
T = TypeVar("T")
Values = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class ScreenSettings:
    """Appearance of the window.

    ``text_scale`` is 1, 1.25 or 1.5; ``language`` a code of two letters or ``system``; ``research`` shows what only
    research needs.
    """

    theme: Literal["light", "dark", "system"] = "system"
    text_scale: float = 1.0
    language: str = "system"
    research: bool = False

    def __post_init__(self) -> None:
        if not 0.5 <= self.text_scale <= 4.0:
            raise ValueError(f"text_scale {self.text_scale} is not between 0.5 and 4")


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """``uri`` of one of several cameras and ``intrinsics``, a ROS camera file; both may be empty."""

    uri: str = ""
    intrinsics: str = ""


@dataclass(frozen=True, slots=True)
class RecordingSettings:
    """Where and how sessions are recorded.

    ``folder`` of patients and sessions is empty for the user's own; ``keep_pictures`` saves video where the disk has
    space; ``smooth`` runs the smoother after each recording; ``start`` is at the key, after a countdown, or when the
    hand lies still.
    """

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
    """Patient records.

    ``retention_years`` is 0 if not set; ``url`` of a clinic's PostgreSQL server (``postgresql://user@host/carpus``)
    and ``sessions``, a shared folder, are empty for this computer alone.
    """

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
    """Idle minutes until the window locks, if there is a PIN; 0 for never."""

    after_min: int = 10

    def __post_init__(self) -> None:
        if not 0 <= self.after_min <= 600:
            raise ValueError(f"after_min {self.after_min} is not between 0 and 600")


@dataclass(frozen=True, slots=True)
class PracticeSystemSettings:
    """Folders of GDT files: ``requests`` with patients to measure, ``results`` that go back; empty for none.

    ``fhir`` writes the results as a FHIR R4 bundle too.
    """

    requests: str = ""
    results: str = ""
    fhir: bool = False


@dataclass(frozen=True, slots=True)
class StreamSettings:
    """``on`` sends live angles, positions and events over Lab Streaming Layer, readable in the network."""

    on: bool = False


@dataclass(frozen=True, slots=True)
class PatientSettings:
    """``sound``: a beep in the patient's view whenever a goal is reached."""

    sound: bool = False


@dataclass(frozen=True, slots=True)
class WelcomeSettings:
    """``answered``: the offer of the first start was answered and is not shown again."""

    answered: bool = False


@dataclass(frozen=True)
class Settings:
    """All sections."""

    screen: ScreenSettings = field(default_factory=ScreenSettings)
    camera: CameraSettings = field(default_factory=CameraSettings)
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    report: ReportSettings = field(default_factory=ReportSettings)
    backup: BackupSettings = field(default_factory=BackupSettings)
    records: RecordsSettings = field(default_factory=RecordsSettings)
    lock: LockSettings = field(default_factory=LockSettings)
    practice_system: PracticeSystemSettings = field(default_factory=PracticeSystemSettings)
    stream: StreamSettings = field(default_factory=StreamSettings)
    patient: PatientSettings = field(default_factory=PatientSettings)
    first_start: WelcomeSettings = field(default_factory=WelcomeSettings)
    live: LiveSettings = field(default_factory=LiveSettings)
    tracking: Mapping[str, Values] = field(default_factory=dict, metadata=NOT_IN_FILE)
    """Sections of :data:`TRACKING` as the user's file has them."""
    run_folder: Path | None = field(default=None, metadata=NOT_IN_FILE)
    """Data folder named for this run only."""

    @cached_property
    def track(self) -> TrackSettings:
        """Settings of tracking, whose modules are imported only here to keep the start fast."""
        from carpus.core.pipeline.track import TrackSettings

        return replace(_build_section(TrackSettings, self.tracking, "", SETTINGS_FILE), smooth=self.recording.smooth)

    @property
    def data_folder(self) -> Path:
        """Folder of patients and sessions: of this run, of ``CARPUS_DATA``, or of the setting."""
        if self.run_folder is not None:
            return self.run_folder
        named = os.environ.get(DATA_VARIABLE) or self.recording.folder
        return expand_home(named) if named else Path(platformdirs.user_data_dir("carpus", appauthor=False))


def sessions_folder(settings: Settings) -> Path | None:
    """Return the shared session folder, None if sessions are in the data folder."""
    return expand_home(settings.records.sessions) if settings.records.sessions else None


def settings_folder() -> Path:
    """Return the folder of the user's settings."""
    return Path(platformdirs.user_config_dir("carpus", appauthor=False))


def load_settings(folder: Path | None = None) -> Settings:
    """Load the defaults, overridden by the user's settings and preferences."""
    settings, faults = load_valid_settings(folder)
    for fault in faults:
        raise fault
    return settings


def load_valid_settings(folder: Path | None = None) -> tuple[Settings, list[CarpusFault]]:
    """Load the settings without the files that cannot be used, and the faults of those."""
    folder = folder or settings_folder()
    # the shipped file, without the tracking sections whose defaults are in the code
    shipped = _parse_toml("defaults.toml", (resources.files("carpus.resources") / "defaults.toml").read_bytes())
    merged: Values = {name: section for name, section in shipped.items() if name not in TRACKING}
    faults: list[CarpusFault] = []
    for name in (SETTINGS_FILE, PREFERENCES_FILE):
        try:
            merged = _merge(merged, _read_own_settings(folder / name))
        except CarpusFault as fault:
            faults.append(fault)
    return _build_settings(merged, "defaults.toml"), faults


def _build_settings(values: Values, file: str) -> Settings:
    """Build all sections; tracking settings are checked now, so that their faults are shown now."""
    tracking = {name: values[name] for name in TRACKING if values.get(name)}
    if tracking:
        from carpus.core.pipeline.track import TrackSettings

        _build_section(TrackSettings, tracking, "", file)
    others = {name: value for name, value in values.items() if name not in TRACKING}
    return replace(_build_section(Settings, others, "", file), tracking=tracking)


def _read_own_settings(path: Path) -> Values:
    """Read and check the user's file; empty if there is none."""
    try:
        own = _update_names(_parse_toml(str(path), path.read_bytes()), path) if path.exists() else {}
    except OSError as cause:
        raise SettingsInvalid(path, cause.strerror or phrase("cannot be read")) from cause
    _build_settings(own, str(path))  # faults name the file they are in
    return own


def _update_names(values: Values, path: Path, where: str = "") -> Values:
    """Drop settings that are not used any more, and give the others their present names."""
    kept: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}{name}"
        if place in OBSOLETE:
            logger.info("The setting %s in %s is not used any more", place, path)
        elif not isinstance(value, Mapping):
            present = FORMER_NAMES.get(place, name)
            if present == name or present not in values:  # the present name counts if both are there
                kept[present] = value
        elif (inner := _update_names(value, path, f"{place}.")) or not value:
            kept[name] = inner
    return kept


_PREFERENCE_FIELDS = {
    "screen": ("theme", "text_scale", "language", "research"),
    "recording": ("folder",),
    "report": ("therapist", "angle_order"),
    "backup": ("folder", "hour"),
    "records": ("retention_years",),
    "lock": ("after_min",),
    "practice_system": ("requests", "results", "fhir"),
    "stream": ("on",),
    "patient": ("sound",),
    "first_start": ("answered",),
}


def save_preferences(before: Settings, chosen: Settings, folder: Path | None = None) -> None:
    """Save what was changed in the window, and nothing else.

    Values of one run and of the user's own file are not saved.

    Raises
    ------
    OutputNotWritable, DiskFull
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
    """Read the preferences; an invalid file is kept under another name."""
    try:
        return {section: dict(values) for section, values in _read_own_settings(path).items()}
    except SettingsInvalid:
        path.replace(path.with_name(f"{path.stem}.unusable{path.suffix}"))
        return {}


def _format_value(value: object) -> str:
    """Format a value as TOML, which writes texts, numbers and booleans as JSON does."""
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{name} = {_format_value(one)}' for name, one in sorted(value.items()))}}}"
    return json.dumps(value, ensure_ascii=False)


def _parse_toml(name: str, data: bytes) -> Values:
    try:
        return tomllib.loads(data.decode("utf-8-sig"))  # editors on Windows put a mark before it
    except RecursionError as cause:
        raise SettingsInvalid(name, phrase("not a valid TOML file: too many nested tables")) from cause
    except ValueError as cause:  # TOML's own faults, text that is none, numbers without end
        raise SettingsInvalid(name, f"not TOML: {cause}"[:200]) from cause


def _merge(below: Values, above: Values) -> Values:
    out = dict(below)
    for name, value in above.items():
        both = isinstance(value, Mapping) and isinstance(out.get(name), Mapping)
        out[name] = _merge(out[name], value) if both else value
    return out


def _build_section(kind: type[T], values: Values, where: str, file: str) -> T:
    """Build a dataclass from a table whose keys must be its fields."""
    hints = typing.get_type_hints(kind)
    known = settable_names(kind)
    found: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}.{name}" if where else name
        if name not in known:
            raise SettingsInvalid(place, phrase("this setting does not exist (file {file})", file=file))
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
    """Return the settings for a data folder named on the command line.

    Server, shared folder and daily backup belong to the own data folder and are switched off.
    """
    if folder is None or folder.absolute() == settings.data_folder.absolute():
        return settings
    records, backup = replace(settings.records, url="", sessions=""), replace(settings.backup, hour=-1)
    return replace(settings, run_folder=folder, records=records, backup=backup)


def with_saved_folder(settings: Settings, folder: Path) -> Settings:
    """Return the settings with another data folder, saved unless this run had its own."""
    if settings.run_folder is not None:
        return replace(settings, run_folder=folder)
    os.environ.pop(DATA_VARIABLE, None)  # it would go over what was just chosen
    chosen = replace(settings, recording=replace(settings.recording, folder=str(folder)))
    with suppress(CarpusFault):
        save_preferences(settings, chosen)
    return chosen
