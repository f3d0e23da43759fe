"""The formats that a session can be written in (one line here and one module for each), and sessions written in them:
one or hundreds, into one folder, in which nothing is overwritten.

A module has ``write(take, folder)`` and, where a format speaks of all sessions together, ``check(folder)`` before the
first, ``complete(folder, provenances)`` after the last and ``OWN_FOLDER``. It is loaded only when it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import date
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from carpus.core.durable import write_fault
from carpus.core.errors import CarpusFault
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm, new_text
from carpus.core.formats.provenance import LEGAL, Deidentification, provenance
from carpus.core.formats.take import Take
from carpus.core.measures.by_hand import HandValue, of_session
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.session.values import Session


class Format(NamedTuple):
    """``words`` say what it is for."""

    module: str
    words: str


FORMATS = {
    "csv": Format(
        "csv_tables",
        "tables of angles, joints, markers, events and measures",
    ),
    "json": Format("json_measures", "measures with provenance"),
    "c3d": Format("c3d_write", "markers for motion capture programs"),
    "trc": Format("trc", "markers for OpenSim"),
    "mot": Format("mot", "angles for OpenSim"),
    "bids": Format("bids_motion", "a BIDS-Motion data set"),
    "h5": Format("session_copy", "the session itself without pictures, to be imported again"),
}


class Writer:
    """One format in one export."""

    def __init__(self, name: str, folder: Path, alone: bool) -> None:
        self._module: Any = import_module(f"{__package__}.{FORMATS[name].module}")
        own = getattr(self._module, "OWN_FOLDER", "")
        self.name, self.folder = name, folder / own if own and not alone else folder
        self._written: list[Mapping[str, Any]] = []

    def check(self) -> None:
        """Raise a fault that is known before anything is written."""
        check = getattr(self._module, "check", None)
        if check is not None:
            check(self.folder)

    def write(self, take: Take) -> Sequence[Path]:
        out: Sequence[Path] = self._module.write(take, self.folder)
        self._written.append(take.provenance)
        return out

    def complete(self) -> Sequence[Path]:
        """What speaks of all sessions."""
        complete = getattr(self._module, "complete", None)
        return complete(self.folder, self._written) if complete is not None and self._written else ()


README = "README.txt"


@dataclass(frozen=True, slots=True)
class Wanted:
    """One session to export: ``path`` of its file; ``read`` gives it as it shall be written, with a person's choices
    of its repetitions."""

    path: Path
    read: Callable[[], tuple[Session, RepetitionChoices | None]]
    by_hand: tuple[HandValue, ...] = ()
    """All that was ever measured by hand of the patient; what counts of the session's day and hand goes along."""

    @classmethod
    def stored(cls, path: Path, choices: Callable[[Path], RepetitionChoices] | None = None) -> Wanted:
        """A session file as it is, with what a person chose of its repetitions as ``choices`` reads that."""
        # The list of formats is read by windows, which load nothing that reads files.
        from carpus.core.session.reader import read_session

        return cls(path, lambda: (read_session(path), None if choices is None else choices(path)))


class Refused(NamedTuple):
    """A session that could not be exported, and why."""

    path: Path
    fault: CarpusFault


@dataclass(frozen=True, slots=True)
class Exported:
    """``files`` written, ``refused`` sessions; ``cancelled`` when somebody stopped it on the way. ``parts`` the files
    of each session by its path; the others are of all of them."""

    folder: Path
    files: tuple[Path, ...]
    refused: tuple[Refused, ...]
    cancelled: bool = False
    parts: Mapping[Path, tuple[Path, ...]] = field(default_factory=dict)


def export_sessions(
    wanted: Iterable[Wanted],
    folder: Path,
    formats: Sequence[str],
    *,
    deidentified: bool = False,
    form: TableForm = FOR_PROGRAMS,
    progress: Callable[[int, int], None] | None = None,
    cancelled: Callable[[], bool] = lambda: False,
) -> Exported:
    """Write sessions in formats into a folder. A session that cannot be read or written is told, the others go on.

    ``form`` is that of the tables (CSV).
    ``progress`` hears (done, total) steps, one for each session and format; ``cancelled`` is asked before each. Raises
    :class:`OutputExists` or :class:`OutputNotWritable` for what is known before the first session.
    """
    sessions = list(wanted)
    unknown = [name for name in formats if name not in FORMATS]
    if unknown:
        raise ValueError(f"no format {', '.join(unknown)}: there are {', '.join(FORMATS)}")
    writers = [Writer(name, folder, alone=len(formats) == 1) for name in formats]
    for writer in writers:
        writer.check()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(folder, cause) from cause
    refused: list[Refused] = []
    nobody = _nobody(sessions) if deidentified else None
    files: list[Path] = []
    parts: dict[Path, tuple[Path, ...]] = {}
    done, total, stopped = 0, len(sessions) * len(writers), False
    names: set[str] = set()
    for one in sessions:
        try:
            take = replace(_take(one, nobody, names), form=form)
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
            refused.append(Refused(one.path, fault))
        if stopped:
            break
    for writer in writers:
        files += writer.complete()
    if len(writers) > 1 and files and not (folder / README).exists():
        files.append(new_text(folder / README, _readme(formats, deidentified)))
    return Exported(folder, tuple(files), tuple(refused), stopped, parts)


def _nobody(sessions: Iterable[Wanted]) -> Deidentification:
    """Names that are nobody's for those whose sessions these are."""
    from carpus.core.session.reader import read_outline

    nobody = Deidentification()
    for one in sessions:
        with suppress(CarpusFault):  # told when it is read
            nobody.know(read_outline(one.path))
    return nobody


def _take(one: Wanted, nobody: Deidentification | None, names: set[str]) -> Take:
    session, choices = one.read()
    camera = session.camera
    # Before anybody's days are moved.
    day = session.header.when.date()
    name = one.path.stem
    if nobody is not None:
        session = nobody.session(session)
        if choices is not None:  # a reason is a person's own words
            kept = {n: why if why in ("", PASSIVE) else "left out" for n, why in choices.left_out.items()}
            choices = replace(choices, left_out=kept, not_counted_reason="")
        name = nobody.name(session.header)
    base, number = name, 1
    while name in names:  # sessions of several folders may share a name
        number += 1
        name = f"{base}-{number}"
    names.add(name)
    said = provenance(session, deidentified=nobody is not None)
    figures = session_figures(session, choices)
    by_hand = of_session(one.by_hand, figures.side, day)
    if nobody is not None:  # day, place and initials are a person's own
        by_hand = tuple(replace(value, day=date.min, where="", by="", entered=None) for value in by_hand)
    return Take(session, figures, name, said, by_hand, camera)


def _readme(formats: Sequence[str], deidentified: bool) -> str:
    of_whom = "Nobody can be found by it: names are new and random, days count from each patient's first session."
    lines = [
        "Sessions of Carpus in open formats.",
        of_whom if deidentified else "Patients are pseudonyms; who they are stays with the clinic.",
        "",
        *(f"{name:6} {FORMATS[name].words}" for name in formats),
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
