"""Export of sessions: the list of formats, and sessions written into one folder without overwriting.

A format is a line here and a module with ``write(item, folder)``. One for all sessions together also has
``check(folder)`` before the first, ``complete(folder, provenances)`` after the last, and ``OWN_FOLDER``. Modules are
loaded when needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import date
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from carpus.core.formats.export_item import ExportItem
from carpus.core.formats.export_provenance import LEGAL, Deidentifier, build_provenance
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect, write_new_text
from carpus.core.measures.manual_measurements import ManualValue, session_values
from carpus.core.model.errors import CarpusFault
from carpus.core.platform.durable import write_fault
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.values import Session


class Format(NamedTuple):
    """Module and description of a format."""

    module: str
    description: str


FORMATS = {
    "csv": Format("csv_tables", "tables of angles, joints, markers, events and measures"),
    "json": Format("json_measures", "measures with provenance"),
    "c3d": Format("c3d", "markers for motion capture programs"),
    "trc": Format("trc", "markers for OpenSim"),
    "mot": Format("mot", "angles for OpenSim"),
    "bids": Format("bids_motion", "a BIDS-Motion data set"),
    "fhir": Format("fhir", "measures for a hospital system (FHIR R4)"),
    "h5": Format("session_copy", "the session itself without pictures, to be imported again"),
}


class FormatWriter:
    """Writer of one format in one export."""

    def __init__(self, name: str, folder: Path, is_only: bool) -> None:
        self._module: Any = import_module(f"{__package__}.{FORMATS[name].module}")
        own = getattr(self._module, "OWN_FOLDER", "")
        self.name, self.folder = name, folder / own if own and not is_only else folder
        self._written: list[Mapping[str, Any]] = []

    def check(self) -> None:
        """Raise a fault that is known before anything is written."""
        check = getattr(self._module, "check", None)
        if check is not None:
            check(self.folder)

    def write(self, take: ExportItem) -> Sequence[Path]:
        out: Sequence[Path] = self._module.write(take, self.folder)
        self._written.append(take.provenance)
        return out

    def complete(self) -> Sequence[Path]:
        """Write the files of all sessions together."""
        complete = getattr(self._module, "complete", None)
        return complete(self.folder, self._written) if complete is not None and self._written else ()


README = "README.txt"


@dataclass(frozen=True, slots=True)
class ExportRequest:
    """Session to export; ``read`` returns it as it shall be written, with a person's choices."""

    path: Path
    read: Callable[[], tuple[Session, RepetitionChoices | None]]
    manual_measurements: tuple[ManualValue, ...] = ()
    """All of the patient; those of the session's day and hand are exported."""

    @classmethod
    def from_file(cls, path: Path, choices: Callable[[Path], RepetitionChoices] | None = None) -> ExportRequest:
        """Request a session file as it is, with choices read by ``choices``."""
        # The list of formats is read by windows, which load nothing that reads files.
        from carpus.core.session.reader import read_session

        return cls(path, lambda: (read_session(path), None if choices is None else choices(path)))


class RefusedSession(NamedTuple):
    """Session that could not be exported, and why."""

    path: Path
    fault: CarpusFault


@dataclass(frozen=True, slots=True)
class ExportResult:
    """Files written and sessions refused.

    ``files_by_session`` are the files of each session; the others belong to all of them.
    """

    folder: Path
    files: tuple[Path, ...]
    refused: tuple[RefusedSession, ...]
    cancelled: bool = False
    files_by_session: Mapping[Path, tuple[Path, ...]] = field(default_factory=dict)


def export_sessions(
    requests: Iterable[ExportRequest],
    folder: Path,
    formats: Sequence[str],
    *,
    deidentified: bool = False,
    dialect: TableDialect = MACHINE_DIALECT,
    progress: Callable[[int, int], None] | None = None,
    cancelled: Callable[[], bool] = lambda: False,
) -> ExportResult:
    """Export sessions into a folder; sessions that fail are reported, the others continue.

    ``dialect`` is that of CSV tables. ``progress`` receives steps done and in all, one for each session and format;
    ``cancelled`` is called before each. Raises :class:`OutputExists` or :class:`OutputNotWritable` for what is known
    before the first session.
    """
    sessions = list(requests)
    unknown = [name for name in formats if name not in FORMATS]
    if unknown:
        raise ValueError(f"no format {', '.join(unknown)}: there are {', '.join(FORMATS)}")
    writers = [FormatWriter(name, folder, is_only=len(formats) == 1) for name in formats]
    for writer in writers:
        writer.check()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    refused: list[RefusedSession] = []
    nobody = _prepare_deidentifier(sessions) if deidentified else None
    files: list[Path] = []
    parts: dict[Path, tuple[Path, ...]] = {}
    done, total, stopped = 0, len(sessions) * len(writers), False
    names: set[str] = set()
    for one in sessions:
        try:
            take = replace(_build_item(one, nobody, names), dialect=dialect)
            for writer in writers:
                stopped = stopped or cancelled()
                if stopped:
                    break
                written = writer.write(take)
                files += written
                parts[one.path] = (*parts.get(one.path, ()), *written)
                done += 1
                if progress is not None:
                    progress(done, total)
        except CarpusFault as fault:
            refused.append(RefusedSession(one.path, fault))
        if stopped:
            break
    for writer in writers:
        files += writer.complete()
    if len(writers) > 1 and files and not (folder / README).exists():
        files.append(write_new_text(folder / README, _readme(formats, deidentified)))
    return ExportResult(folder, tuple(files), tuple(refused), stopped, parts)


def _prepare_deidentifier(sessions: Iterable[ExportRequest]) -> Deidentifier:
    """Return new names for the subjects of all sessions."""
    from carpus.core.session.reader import read_outline

    nobody = Deidentifier()
    for one in sessions:
        with suppress(CarpusFault):  # told when it is read
            nobody.register(read_outline(one.path))
    return nobody


def _build_item(request: ExportRequest, deidentifier: Deidentifier | None, names: set[str]) -> ExportItem:
    session, choices = request.read()
    camera = session.camera
    # Before anybody's days are moved.
    day = session.header.recording_time.date()
    name = request.path.stem
    if deidentifier is not None:
        session = deidentifier.deidentify(session)
        if choices is not None:  # a reason is a person's own words
            kept = {n: why if why in ("", PASSIVE) else "left out" for n, why in choices.excluded.items()}
            choices = replace(choices, excluded=kept, session_exclusion_reason="")
        name = deidentifier.new_file_stem(session.header)
    base, number = name, 1
    while name in names:  # sessions of several folders may share a name
        number += 1
        name = f"{base}-{number}"
    names.add(name)
    item_provenance = build_provenance(session, deidentified=deidentifier is not None)
    figures = compute_session_results(session, choices)
    by_hand = session_values(request.manual_measurements, figures.side, day)
    if deidentifier is not None:  # day, place and initials are a person's own
        by_hand = tuple(replace(value, day=date.min, location="", rater="", entered_at=None) for value in by_hand)
    return ExportItem(session, figures, name, item_provenance, by_hand, camera)


def _readme(formats: Sequence[str], deidentified: bool) -> str:
    of_whom = "Nobody can be found by it: names are new and random, days count from each patient's first session."
    lines = [
        "Sessions of Carpus in open formats.",
        of_whom if deidentified else "Patients are pseudonyms; who they are stays with the clinic.",
        "",
        *(f"{name:6} {FORMATS[name].description}" for name in formats),
        "",
        "Lengths and angles carry their units in names, headers or the .json beside each file; what is not known is",
        "NaN, an empty cell, n/a or a residual of -1, never 0. Wrist: + radial, + flexion, + supination on both hands.",
        "pronosupination is counted from the palm down; supination and pronation, by their names, from thumb up, as in",
        "clinics: a palm flat on the table is 0 of the first, and at 90 degrees of pronation.",
        "A .h5 is imported by copying it into the data folder of Carpus.",
        "",
        LEGAL,
    ]
    return "\n".join(lines) + "\n"
