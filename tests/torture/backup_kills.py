"""Kills at random moments of a back-up and of a restore: no back-up that is none, nothing half, nothing left behind."""

from __future__ import annotations

import os
import random
import shutil
import signal
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path

from carpus.core.records.backup import OBJECTS, create_backup, list_backups, prune_backups, verify_backup
from carpus.core.records.restoring import LogHistory, activate_restored, delete_unfinished, has_restored_folder, restore
from tests.records.samples import LINDEN, T0, measure, opened

NOW = datetime(2026, 11, 20, 18, 0, tzinfo=UTC)
KINDS = ("back-up", "restore", "restore over what is there")
PICTURES = 12
PICTURE_BYTES = 400_000


def data_folder(folder: Path) -> Path:
    """Sessions with pictures beside them."""
    with opened(folder) as house:
        linden = house.patients.add(LINDEN)
        for day in range(3):
            measure(house, linden, T0 + timedelta(days=day))
    for number in range(PICTURES):
        (folder / f"kept{number}.carpusraw").write_bytes(random.Random(number).randbytes(PICTURE_BYTES))
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    """Every file but the store, whose pages may be laid otherwise, and its lock, which no back-up takes."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and ".sqlite3" not in path.name and path.suffix != ".lock"
    }


def killed_after(work: Callable[[], object], after_s: float) -> bool:
    """Do something in a process of its own that is killed after some time; whether it had ended before."""
    child = os.fork()
    if child == 0:
        try:
            work()
        finally:
            os._exit(0)
    time.sleep(after_s)
    os.kill(child, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


class Kills:
    """Of one kind, in a folder of their own."""

    def __init__(self, kind: str, folder: Path) -> None:
        self.kind, self._folder = kind, folder
        folder.mkdir(parents=True)
        self._data, self._place = data_folder(folder / "data"), folder / "disk"
        begin_s = time.monotonic()
        self._made = create_backup(self._data, self._place, now=NOW)
        if kind != "back-up":
            begin_s = time.monotonic()
            restore(self._made, self._place, folder / "first", LogHistory())
        self._took_s = time.monotonic() - begin_s
        self._whole = contents(self._data)
        self.ended = 0

    def once(self, number: int) -> None:
        """One kill; raises AssertionError where what must hold does not."""
        after_s = random.Random(f"{self.kind} {number}").uniform(0.0, 1.2 * self._took_s)
        self.ended += self._back_up(number, after_s) if self.kind == "back-up" else self._restore(number, after_s)

    def _back_up(self, number: int, after_s: float) -> bool:
        for one in range(PICTURES):
            (self._data / f"kept{one}.carpusraw").write_bytes(random.Random(f"{number} {one}").randbytes(PICTURE_BYTES))
        before = list_backups(self._place)
        when = NOW + timedelta(minutes=number + 1)
        ended = killed_after(lambda: create_backup(self._data, self._place, now=when), after_s)
        after = list_backups(self._place)
        assert len(after) - len(before) in ((1,) if ended else (0, 1))
        for one in after[:2]:
            verify_backup(self._place, one)
        made = create_backup(self._data, self._place, now=when + timedelta(seconds=30))
        prune_backups(self._place, 1, 0, made.made)
        assert [one.name for one in list_backups(self._place)] == [made.name]
        needed = {one.sha256 for one in made.files}
        left = {path.name for path in (self._place / OBJECTS).rglob("*") if path.is_file()}
        assert left == needed, "what a killed one wrote is still there"
        return ended

    def _restore(self, number: int, after_s: float) -> bool:
        target = self._folder / f"target{number}"
        replaces = self.kind != "restore"
        if replaces:
            target.mkdir()
            (target / "old").write_text("old")

        def work() -> None:
            restore(self._made, self._place, target, LogHistory(), overwrite=replaces)
            activate_restored(target, NOW)

        ended = killed_after(work, after_s)
        if has_restored_folder(target):
            activate_restored(target, NOW)
        delete_unfinished(target)
        asides = list(self._folder.glob(f"{target.name}.before-restore-*"))
        if target.exists() and contents(target) != {"old": b"old"}:
            assert contents(target) == self._whole, "half of it"
            assert [contents(one) for one in asides] == ([{"old": b"old"}] if replaces else [])
        else:
            assert not ended
            assert target.exists() == replaces
            assert asides == []
        for path in (target, *asides):
            shutil.rmtree(path, ignore_errors=True)
        return ended


def line(kind: str, count: int, folder: Path) -> str:
    """So many kills of one kind, in words."""
    kills, number = Kills(kind, folder), 0
    while number - kills.ended < count:
        kills.once(number)
        number += 1
    return f"kills, {kind}: {count} ({kills.ended} came too late); nothing half, nothing left, the next one whole"
