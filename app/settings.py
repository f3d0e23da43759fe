"""All that a person may choose, gathered: frozen sections read from TOML over the shipped defaults.

Each section is declared beside the code it configures; an unknown key or a value of the wrong kind is
:class:`SettingsInvalid` and names the key.
"""

from __future__ import annotations

import json
import os
import tomllib
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from importlib import resources
from pathlib import Path
from typing import Any, Literal, TypeVar

import platformdirs

from core.calibration.settings import CalibrationSettings
from core.detection.settings import DetectionSettings
from core.errors import OutputNotWritable, SettingsInvalid
from core.pipeline.live import LiveSettings
from core.pipeline.track import TrackSettings
from core.session.register import default_data_folder
from core.tracking.settings import TrackerSettings

SETTINGS_FILE, PREFERENCES_FILE = "settings.toml", "preferences.toml"
"""The first is written by people, the second by the window; the second goes over the first."""

DATA_VARIABLE = "CARPUS_DATA"

T = TypeVar("T")
Values = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class ScreenSettings:
    """``theme`` of the window; ``text_scale`` 1, 1.25 or 1.5; ``keys`` that a person gave to actions."""

    theme: Literal["light", "dark", "system"] = "system"
    text_scale: float = 1.0
    keys: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """``uri`` of one of several cameras; ``intrinsics`` a ROS camera file measured for it; both may be empty."""

    uri: str = ""
    intrinsics: str = ""


@dataclass(frozen=True, slots=True)
class RecordingSettings:
    """``folder`` of patients and sessions, empty for the user's own; ``keep_pictures`` raw pictures with each
    session; ``smooth`` each session when it is stored."""

    folder: str = ""
    keep_pictures: bool = False
    smooth: bool = True


@dataclass(frozen=True, slots=True)
class ReportSettings:
    """``therapist`` initials that are printed on reports."""

    therapist: str = ""


@dataclass(frozen=True, slots=True)
class Settings:
    """Everything, one section each."""

    screen: ScreenSettings = field(default_factory=ScreenSettings)
    camera: CameraSettings = field(default_factory=CameraSettings)
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    report: ReportSettings = field(default_factory=ReportSettings)
    live: LiveSettings = field(default_factory=LiveSettings)
    detection: DetectionSettings = field(default_factory=DetectionSettings)
    calibration: CalibrationSettings = field(default_factory=CalibrationSettings)
    tracker: TrackerSettings = field(default_factory=TrackerSettings)

    @property
    def track(self) -> TrackSettings:
        """What decides how pictures become a session."""
        return TrackSettings(self.detection, self.calibration, self.tracker, self.recording.smooth)

    @property
    def data_folder(self) -> Path:
        """Where patients and sessions are; ``CARPUS_DATA`` goes over the setting."""
        named = os.environ.get(DATA_VARIABLE) or self.recording.folder
        return Path(named).expanduser() if named else default_data_folder()


def settings_folder() -> Path:
    """Where this person's settings are."""
    return Path(platformdirs.user_config_dir("carpus", appauthor=False))


def load_settings(folder: Path | None = None) -> Settings:
    """The shipped defaults with this person's settings and what was chosen in the window over them."""
    folder = folder or settings_folder()
    defaults = resources.files("resources") / "defaults.toml"
    merged = _read("defaults.toml", defaults.read_bytes())
    for name in (SETTINGS_FILE, PREFERENCES_FILE):
        path = folder / name
        if path.exists():
            try:
                own = _read(str(path), path.read_bytes())
            except OSError as cause:
                raise SettingsInvalid(path, cause.strerror or "cannot be read") from cause
            _filled(Settings, own, "", str(path))  # faults name the file they are in
            merged = _merged(merged, own)
    return _filled(Settings, merged, "", "defaults.toml")


def keep_preferences(chosen: Settings, folder: Path | None = None) -> None:
    """Store what the window lets a person choose. Raises :class:`OutputNotWritable`."""
    path = (folder or settings_folder()) / PREFERENCES_FILE
    screen = chosen.screen
    lines = [
        "# Chosen in the window of Carpus.",
        "[screen]",
        f"theme = {_text(screen.theme)}",
        f"text_scale = {float(screen.text_scale)}",
        "[screen.keys]",
        *(f"{name} = {_text(key)}" for name, key in sorted(screen.keys.items())),
        "[recording]",
        f"folder = {_text(chosen.recording.folder)}",
        "[report]",
        f"therapist = {_text(chosen.report.therapist)}",
    ]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(".part")
        part.write_text("\n".join([*lines, ""]), encoding="utf-8")
        part.replace(path)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _text(value: str) -> str:
    return json.dumps(value, ensure_ascii=False)


def _read(name: str, data: bytes) -> Values:
    try:
        return tomllib.loads(data.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as cause:
        raise SettingsInvalid(name, f"not TOML: {cause}") from cause


def _merged(below: Values, above: Values) -> Values:
    out = dict(below)
    for name, value in above.items():
        both = isinstance(value, Mapping) and isinstance(out.get(name), Mapping)
        out[name] = _merged(out[name], value) if both else value
    return out


def _filled(kind: type[T], values: Values, where: str, file: str) -> T:
    """A dataclass from a table; every key must be one of its fields."""
    hints = typing.get_type_hints(kind)
    known = {item.name for item in fields(kind)}  # type: ignore[arg-type]
    found: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}.{name}" if where else name
        if name not in known:
            raise SettingsInvalid(place, f"there is no such setting, in {file}")
        found[name] = _value(hints[name], value, place, file)
    try:
        return kind(**found)
    except ValueError as cause:
        raise SettingsInvalid(where, f"{cause}, in {file}") from cause


def _value(hint: Any, value: Any, place: str, file: str) -> Any:
    """``value`` as the type of the field, or the fault that names the field."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if is_dataclass(hint) and isinstance(hint, type) and isinstance(value, Mapping):
        return _filled(hint, value, place, file)
    if origin is Literal and value in arguments:
        return value
    if origin is tuple and isinstance(value, list):
        kinds = arguments[:1] * len(value) if arguments[-1] is Ellipsis else arguments
        if len(kinds) == len(value):
            return tuple(_value(one, item, place, file) for one, item in zip(kinds, value, strict=True))
    if origin is Mapping and isinstance(value, Mapping):
        return {str(name): _value(arguments[1], item, place, file) for name, item in value.items()}
    if origin in (typing.Union, types.UnionType):
        wanted = next(one for one in arguments if one is not type(None))
        return _value(wanted, value, place, file)
    if hint is Path and isinstance(value, str):
        return Path(value).expanduser()
    if hint is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(hint, type) and type(value) is hint:
        return value
    names = {float: "a number", int: "a whole number", bool: "true or false", str: "a text"}
    wanted_words = " or ".join(map(str, arguments)) if origin is Literal else names.get(hint, "another kind of value")
    raise SettingsInvalid(place, f"{value!r} is not {wanted_words}, in {file}")
