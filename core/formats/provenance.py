"""What every export says of itself: of which session, by which program, from which recording, camera and settings."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from datetime import UTC, datetime
from typing import Any

from carpus.core import provenance as made_by
from carpus.core.session.values import Session

LEGAL = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)
OF_NO_ONE = (
    "depth_sensor", "depth_unit_m", "format", "intrinsics", "nominal_fps", "registered", "mirrored", "simulated",
    "driver",
)  # fmt: skip
"""What a de-identified export says of the source: nothing that names a device, a file or a day."""


def provenance(
    session: Session, software_version: str, deidentified: bool = False, now: datetime | None = None
) -> dict[str, Any]:
    """As plain values for JSON; ``software_version`` of the program that runs, ``now`` is injectable.

    De-identified: no hash, name or date leads back.
    """
    header = session.header
    parameters = json.loads(header.parameters)
    parameters = parameters if isinstance(parameters, dict) else {}
    source, settings = _part(parameters, "source"), _part(parameters, "settings")
    out: dict[str, Any] = {
        "made_by": {"program": "Carpus", "version": software_version, "revision": made_by.revision()},
        "of": {
            "subject_id": header.subject_id,
            "session_id": header.session_id,
            "recording_id": header.recording_id,
            "tracked_again_from": header.origin,
            "hand": header.hand,
            "protocol": header.protocol.name,
            "exercise": header.exercise,
            "simulated": header.simulated,
        },
        "tracked_by": {
            "version": header.software_version,
            "revision": _part(parameters, "provenance").get("revision", ""),
            "settings_sha256": made_by.sha256_of_settings(settings) if settings else "",
        },
        "camera": asdict(session.camera) | {"source": {name: source[name] for name in sorted(source)}},
        "deidentified": deidentified,
        "legal": LEGAL,
    }
    if deidentified:
        out["camera"]["source"] = {name: source[name] for name in OF_NO_ONE if name in source}
        return out
    out["made"] = (now or datetime.now(UTC)).isoformat(timespec="seconds")
    out["of"]["session_sha256"] = made_by.sha256_of_file(session.path) if session.path.is_file() else ""
    out["of"]["recording_sha256"] = source.get("sha256", "")
    out["recorded"], out["session_made"] = header.recorded, header.created
    return out


def _part(parameters: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    part = parameters.get(name)
    return part if isinstance(part, Mapping) else {}
