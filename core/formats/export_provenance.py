"""Provenance of every export, and de-identified sessions (clinical reference 8.5).

De-identified sessions have new random names, counted days and no texts.
"""

from __future__ import annotations

import json
import secrets
import uuid
from dataclasses import asdict, dataclass, field, replace
from datetime import UTC, datetime
from typing import Any

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.types import FloatArray
from carpus.core.platform import provenance as made_by
from carpus.core.platform.version import __version__
from carpus.core.session.values import SET_UP, Event, Session, SessionHeader, SessionOutline

LEGAL = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)
ANONYMOUS_SOURCE_FIELDS = (
    "depth_sensor", "depth_unit_m", "format", "intrinsics", "nominal_fps", "registered", "mirrored", "simulated",
    "driver",
)  # fmt: skip
"""Fields of the source that name no device, file or day."""
FOCAL_STEP_SHARE = 25.0 / 640.0
"""Of the image width; cameras of one kind differ by less."""


def build_provenance(session: Session, deidentified: bool = False) -> dict[str, Any]:
    """Return the provenance as values for JSON; de-identified, without hash, name or date."""
    header = session.header
    source, settings = (made_by.parameter_section(header.parameters, part) for part in ("source", "settings"))
    out: dict[str, Any] = {
        "made_by": {"program": "Carpus", "version": __version__, "revision": made_by.source_revision()},
        "of": {
            "subject_id": header.subject_id,
            "session_id": header.session_id,
            "recording_id": header.recording_id,
            "tracked_again_from": header.origin,
            "hand": header.hand,
            "protocol": header.protocol.name,
            "exercise": header.exercise,
            "simulated": header.is_simulated,
        },
        "tracked_by": {
            "version": header.software_version,
            "revision": made_by.parameter_section(header.parameters, "provenance").get("revision", ""),
            "settings_sha256": made_by.sha256_of_settings(settings) if settings else "",
        },
        "camera": asdict(session.camera) | {"source": {name: source[name] for name in sorted(source)}},
        "deidentified": deidentified,
        "legal": LEGAL,
    }
    if deidentified:
        out["camera"]["source"] = {name: source[name] for name in ANONYMOUS_SOURCE_FIELDS if name in source}
        return out
    out["made"] = datetime.now(UTC).isoformat(timespec="seconds")
    out["of"]["session_sha256"] = made_by.sha256_of_file(session.path) if session.path.is_file() else ""
    out["of"]["recording_sha256"] = source.get("sha256", "")
    out["recorded"], out["session_made"] = header.recorded, header.created
    return out


def generic_camera(camera: Camera) -> Camera:
    """Return a camera of this kind without the traits of one unit: no distortion, rounded focal length.

    >>> camera = generic_camera(Camera(531.2, 529.8, 312.4, 247.1, distortion=(0.03, -0.1, 0.0, 0.001, 0.0)))
    >>> camera.fx_px, camera.fy_px, camera.cx_px, camera.is_distorted
    (525.0, 525.0, 319.5, False)
    """
    step_px = FOCAL_STEP_SHARE * camera.width_px
    focal_px = step_px * round((camera.fx_px + camera.fy_px) / 2.0 / step_px)
    sensor = replace(camera.sensor, focal_px=step_px * round(camera.sensor.focal_px / step_px))
    return Camera(
        focal_px, focal_px, (camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0, camera.width_px,
        camera.height_px, origin=camera.origin, sensor=sensor,
    )  # fmt: skip


def reproject_pixels(pixel: FloatArray, old: Camera, new: Camera) -> FloatArray:
    """Convert pixels (..., 2) of one camera to another one at its place; NaN stays."""
    out = np.asarray(pixel, dtype=np.float64).reshape(-1, 2).copy()
    known = np.isfinite(out).all(axis=1)
    ideal = old.undistort(out[known])
    out[known] = new.distort(new.project(old.backproject(ideal, np.ones(len(ideal)))))
    return out.reshape(np.shape(pixel))


DAY_ZERO = datetime(1900, 1, 1, tzinfo=UTC)
"""Day of a patient's first session; BIDS marks shifted dates by a year before 1925."""
_SETUP_FIELDS = ("targets_deg", "repetitions", "ends_free")
_LEARNT_TIME_FIELD = "neutral_ends_s"


@dataclass(slots=True)
class Deidentifier:
    """New names for one export: the same for the same patient and recording; no list is kept."""

    _subjects: dict[str, str] = field(default_factory=dict)
    _ids: dict[str, str] = field(default_factory=dict)
    _first_day: dict[str, datetime] = field(default_factory=dict)
    _names: dict[str, int] = field(default_factory=dict)

    def register(self, outline: SessionOutline) -> None:
        """Register a session before the first is written, so that days count from the earliest."""
        header = outline.header
        if header.recorded:
            day = _day(header.recorded)
            self._first_day[header.subject_id] = min(day, self._first_day.get(header.subject_id, day))

    def deidentify(self, session: Session) -> Session:
        """Return the session with times from zero, without texts of people and traits of the device.

        Pixels are those of a generic camera: from exact pixels and positions the clinic's camera could be computed.
        """
        start_s = float(session.timestamp_s[0]) if len(session) else 0.0
        old, new = session.camera, generic_camera(session.camera)
        clicks, verdict = session.calibration.clicks, session.calibration.verdict
        findings = tuple(
            replace(one, spot_px=tuple(reproject_pixels(np.array(one.spot_px), old, new))) if one.spot_px else one
            for one in verdict.findings
        )
        return replace(
            session,
            camera=new,
            calibration=replace(
                session.calibration,
                clicks=replace(clicks, pixel=reproject_pixels(clicks.pixel, old, new)),
                verdict=replace(verdict, findings=findings),
            ),
            markers=replace(session.markers, measured_px=reproject_pixels(session.markers.measured_px, old, new)),
            header=self._header(session.header, start_s),
            timestamp_s=session.timestamp_s - start_s,
            events=tuple(
                Event(event.time_s - start_s, event.kind, event.text if event.text.isdigit() else "")
                for event in session.events
            ),
            recovered="",
            repetitions=None,  # counted again where they are asked for
        )

    def new_file_stem(self, header: SessionHeader) -> str:
        """Return a file name from a de-identified header."""
        day = f"day{(_day(header.recorded) - DAY_ZERO).days:04d}" if header.recorded else "day"
        stem = f"{header.subject_id}_{day}"
        self._names[stem] = self._names.get(stem, 0) + 1
        return f"{stem}_{self._names[stem]}"

    def _header(self, header: SessionHeader, start_s: float) -> SessionHeader:
        recorded = ""
        if header.recorded:
            day = _day(header.recorded)
            offset = day - self._first_day.setdefault(header.subject_id, day)
            recorded = (DAY_ZERO + offset).isoformat(timespec="seconds")
        known = {exercise.id for exercise in EXERCISES}
        sections = {
            part: section
            for part in ("settings", "learnt")
            if (section := made_by.parameter_section(header.parameters, part))
        }
        if isinstance(sections.get("learnt", {}).get(_LEARNT_TIME_FIELD), (int, float)):
            sections["learnt"][_LEARNT_TIME_FIELD] -= start_s
        for part, names in (
            ("source", ANONYMOUS_SOURCE_FIELDS),
            (SET_UP, _SETUP_FIELDS),
            ("provenance", ("revision",)),
        ):
            if section := made_by.parameter_section(header.parameters, part):
                sections[part] = {name: section[name] for name in names if name in section}
        return replace(
            header,
            session_id=self._id(header.session_id),
            recording_id=self._id(header.recording_id),
            subject_id=self._subjects.setdefault(header.subject_id, f"S{secrets.token_hex(4)}"),
            recorded=recorded,
            created=recorded or DAY_ZERO.isoformat(timespec="seconds"),
            exercise=header.exercise if header.exercise in known else "",
            origin="",
            parameters=json.dumps(sections, sort_keys=True),
        )

    def _id(self, old: str) -> str:
        return self._ids.setdefault(old, str(uuid.uuid4()))


def _day(moment: str) -> datetime:
    """Return the day on the clinic's clock, whatever its zone."""
    return datetime.fromisoformat(moment).replace(hour=0, minute=0, second=0, microsecond=0, tzinfo=UTC)
