"""Recordings whose data folder went away while they ran: where they went on, and how they come home."""

from __future__ import annotations

import contextlib
import hashlib
import shutil
from collections.abc import Callable
from pathlib import Path

import platformdirs

from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.durable import make_private, sync_folder
from carpus.core.errors import CarpusFault, OutputNotWritable, RecordingReturned, WaitingErased
from carpus.core.records.set_up import MARKERS_SUFFIX
from carpus.core.session.disk import free_name
from carpus.core.session.reader import read_outline
from carpus.core.session.recovery import recover_folder


def fallback_place(data_folder: Path) -> Path:
    """On the disk of this computer, one folder for each data folder; nothing is made."""
    name = hashlib.sha256(str(data_folder.absolute()).encode()).hexdigest()[:12]
    return Path(platformdirs.user_state_dir("carpus", appauthor=False)) / "recorded-elsewhere" / name


def bring_home(data_folder: Path, folder_of: Callable[[str, str], Path | None]) -> list[CarpusFault]:
    """Finish what was recorded elsewhere and move it among the sessions, into the folder of each patient, by identity
    and pseudonym; of whom there is none, it is erased. Tells of each, and of what could not be."""
    place = fallback_place(data_folder)
    if not place.is_dir():
        return []
    found = recover_folder(place)
    told: list[CarpusFault] = []
    erased = [one for one in sorted(place.iterdir()) if one.is_dir() and folder_of(one.name, "") is None]
    for folder in erased if not found.busy else ():
        try:
            shutil.rmtree(folder)  # also what cannot be read, and pictures without a session
            told.append(WaitingErased())
        except OSError as cause:
            told.append(OutputNotWritable(place, cause.strerror or ""))
    told += [fault for fault in found.faults if not any(Path(fault.subject).is_relative_to(one) for one in erased)]
    for path in sorted(place.rglob("*.h5")):
        try:
            home = folder_of(path.parent.name, read_outline(path).header.subject_id)
            told.append(WaitingErased() if home is None else RecordingReturned(_home(path, home)))
            for suffix in (".h5", RAW_SUFFIX, MARKERS_SUFFIX):
                path.with_suffix(suffix).unlink(missing_ok=True)
            if path.parent != place:
                with contextlib.suppress(OSError):  # another recording waits in it
                    path.parent.rmdir()
        except CarpusFault as fault:
            told.append(fault)
        except OSError as cause:
            told.append(OutputNotWritable(data_folder, cause.strerror or ""))
    return told


def _home(path: Path, folder: Path) -> Path:
    make_private(folder)
    target = free_name(folder / path.name)
    for suffix in (RAW_SUFFIX, MARKERS_SUFFIX, ".h5"):  # the session last: what goes with it is there when it comes
        source = path.with_suffix(suffix)
        if source.is_file():
            part = target.with_suffix(suffix + ".arriving")
            shutil.copyfile(source, part)
            part.chmod(0o600)
            part.rename(target.with_suffix(suffix))
    sync_folder(folder)
    return target
