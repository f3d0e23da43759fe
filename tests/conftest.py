"""What every test gets: one BLAS thread, no screen, folders of its own, and no thread left behind."""

from __future__ import annotations

import fcntl
import gc
import hashlib
import itertools
import multiprocessing
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, settings
from tqdm import tqdm

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication
    from pytestqt.qtbot import QtBot

    from carpus.app.desktop.window import Desktop
    from carpus.core.simulation.spec import RecordingSpec
    from tests.commands import Command

# Before anything imports NumPy or Qt: two BLAS pools stall each other, and there is no screen to open windows on.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
# What one process compiled, the next hundreds need not, whatever this computer has as its habit.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
os.environ["LANGUAGE"] = "en_GB"  # the window speaks the computer's language; what is expected here is English

# The same examples everywhere and each time, and no limit of time: a busy machine is no fault of the program.
# `--hypothesis-profile=default` looks for new ones.
settings.register_profile("carpus", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("carpus")

_FOLDERS = ("XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME")
_SERVES_ALL = "carpus-reading"
"""The process that reads session files: one for the whole run, as for the whole program."""
_GRACE_S = 60.0
"""How long a thread may take to end after its test; a leak never ends, so the figure only delays the report."""

_UNITS = {
    "calibration", "compiled", "detection", "formats", "measures", "model", "research", "tracking", "test_camera.py",
    "test_depth_sensor.py", "test_disks.py", "test_forbidden_words.py", "test_house.py",
    "test_names.py", "test_readings.py", "test_so3.py", "test_words.py",
}  # fmt: skip
"""Tests that need no window, no process, no server; those of them that ask for a recording are journeys."""
_WINDOWS = {"ui", "app", "results"}
_ABOVE_SIMULATION = {"research", "pipeline", "records", "formats", "results"}
"""Floors of core that the simulation cannot import (``pyproject.toml``): no recording looks otherwise by them."""
_OLD_S = 86_400.0
"""Recordings of an earlier state of the program may still be in use by another run, after a day they are not."""
_PATIENCE_MS = 60_000
"""How long a window may take to what a test waits for; what never comes only fails later."""


_SOURCES = Path(__file__).parents[1] / "core" / "compiled"
_CHECKED = "CARPUS_BOUNDS_CHECKED"
"""Set: what is compiled runs as built by ``make compiled checked=1``, with every index checked."""


def _take_compiled() -> None:
    """Nothing is tested that was compiled of an older source."""
    place = Path(__file__).parents[1] / "build/checked/carpus/core/compiled" if os.environ.get(_CHECKED) else _SOURCES
    for source in _SOURCES.glob("[!_]*.py"):
        library = place / f"{source.stem}.abi3.so"
        if not library.exists() or library.stat().st_mtime < source.stat().st_mtime:
            ask = "make compiled checked=1" if os.environ.get(_CHECKED) else "make compiled"
            raise pytest.UsageError(f"{source.name} has changed since it was compiled; run: {ask}")
    if os.environ.get(_CHECKED):
        os.environ["CARPUS_UNCOMPILED"] = "1"  # else the package would load its own
        from carpus.core import compiled

        del os.environ["CARPUS_UNCOMPILED"]
        compiled.__path__.insert(0, str(place))


def pytest_configure() -> None:
    """A busy computer is no fault of the program: five seconds, as the plug-in has it, are too few there."""
    from pytestqt.qtbot import QtBot

    _take_compiled()
    tqdm.monitor_interval = 0  # the bars' own thread would outlive the test
    QtBot.waitUntil.__kwdefaults__["timeout"] = _PATIENCE_MS
    QtBot.waitSignal.__kwdefaults__["timeout"] = _PATIENCE_MS


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """One more than there are cores: what plays in real time or waits for another process leaves its core to others."""
    return len(os.sched_getaffinity(0)) + 1


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """What is loaded and collected by now stays: the collector need not look through it again and again.

    From here on garbage is collected between tests, in their thread, as the window does in its own: Qt's objects must
    not be destroyed in another one.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()


_TESTS = itertools.count(1)


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown() -> None:
    gc.collect(1 if next(_TESTS) % 20 else 2)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> Iterator[None]:
    """Puts each test in its suite, before pytest chooses among them.

    What is made once for a file or folder is made in one process: else each process makes it again.
    """
    for item in items:
        if item.get_closest_marker("thorough") is None:
            item.add_marker(_suite(item))
        made = getattr(item, "_fixtureinfo", None)
        places = [
            fixture.baseid
            for fixtures in (made.name2fixturedefs.values() if made else ())
            for fixture in fixtures
            if fixture.scope in ("module", "package") and fixture.baseid.startswith("tests/")
        ]
        if places and item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(min(places, key=len)))
    yield
    for item in items:  # pytest 9.2 has the name that xdist 3.8 gives to a test of a group elsewhere
        if "@" in (name := getattr(item, "_nodeid", "")):
            item._id = type(item.id).parse(name)


def _suite(item: pytest.Item) -> str:
    folder = item.path.relative_to(Path(__file__).parent).parts[0]
    if folder in _UNITS and "rendered" not in getattr(item, "fixturenames", ()):
        return "unit"
    return "window" if folder in _WINDOWS else "journey"


@pytest.fixture(autouse=True, scope="session")
def window_application(qapp: QApplication) -> QApplication:
    """There from the start: a test that prints a report without a window would make a lesser one, and there is only
    one in a process."""
    return qapp


@pytest.fixture(autouse=True)
def windows_let_go(qapp: QApplication) -> Iterator[None]:
    """Windows go with the test that made them: left alive, they make every later change of style as slow as all of them
    together."""
    there = set(qapp.topLevelWidgets())
    yield
    made = [widget for widget in qapp.topLevelWidgets() if widget not in there and widget.parent() is None]
    for widget in made:
        widget.deleteLater()
    if made:
        from PySide6.QtCore import QEvent

        qapp.processEvents()
        qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)  # outside a running loop nobody does


@pytest.fixture(scope="session")
def homes(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A new folder for whoever asks; pytest itself looks through all that there are for each that it makes."""
    root = tmp_path_factory.mktemp("homes")
    return (root / str(number) for number in itertools.count())


@pytest.fixture(autouse=True)
def own_folders(homes: Iterator[Path], monkeypatch: pytest.MonkeyPatch) -> Path:
    """Settings, patients and caches of the person who runs the tests are neither read nor written.

    Child processes inherit it. Returns the folder that stands for the person's home.
    """
    home = next(homes)
    for name in _FOLDERS:
        folder = home / name.lower()
        folder.mkdir(mode=0o700, parents=True)
        monkeypatch.setenv(name, str(folder))
    return home


@pytest.fixture(scope="session")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Callable[[RecordingSpec], Path]:
    """The folder with the simulated recording of a spec: the run's own copy, of what is rendered once into ``build``
    for as long as what may be imported for it and the pins stay as they are."""
    from carpus.core.simulation.recording import render_cached

    root, run = Path(__file__).parents[1], tmp_path_factory.getbasetemp()
    floors = [path for path in sorted((root / "core").iterdir()) if path.name not in _ABOVE_SIMULATION]
    made_by = [root / "requirements.lock", *(path for floor in floors for path in sorted(floor.rglob("*.[pch]*")))]
    state = hashlib.sha256(
        b"".join(path.read_bytes() for path in made_by if path.suffix in (".lock", ".py", ".c", ".h"))
    )
    kept = root / "build" / "rendered" / state.hexdigest()[:16]
    folder = (run.parent if "PYTEST_XDIST_WORKER" in os.environ else run) / "rendered"
    for place in (kept, folder):
        place.mkdir(parents=True, exist_ok=True)
    os.utime(kept)
    for other in kept.parent.iterdir():
        if time.time() - other.stat().st_mtime > _OLD_S:
            shutil.rmtree(other, ignore_errors=True)

    def recording(spec: RecordingSpec) -> Path:
        own = folder / spec.cache_key
        with (folder / f"{spec.cache_key}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)  # another process renders it already
            if not own.exists():
                shutil.copytree(render_cached(spec, cache=kept), own)
            return own

    return recording


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Command:
    """Runs a command of ``carpus`` in this process."""
    from carpus.app.__main__ import main
    from tests.commands import Done

    def run(*words: str | Path) -> Done:
        capsys.readouterr()
        try:
            code = main([str(word) for word in words])
        except SystemExit as end:
            code = int(end.code or 0)
        return Done(code, *capsys.readouterr())

    return run


@pytest.fixture
def open_desktop(qapp: QApplication, qtbot: QtBot, tmp_path: Path) -> Iterator[Callable[..., Desktop]]:
    """Puts the whole window together on the data folder ``tmp_path / "data"``, and ends it with all that works for it;
    takes the settings, the light theme unless they say otherwise, and what ``compose`` takes."""
    from PySide6.QtCore import QLocale

    from carpus.app import compose
    from carpus.app.settings import ScreenSettings, Settings

    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    opened: list[Desktop] = []

    def open_one(settings: Settings | None = None, **options: Any) -> Desktop:
        chosen = settings or Settings(screen=ScreenSettings("light"))
        chosen = replace(chosen, recording=replace(chosen.recording, folder=str(tmp_path / "data")))
        opened.append(compose.compose(qapp, chosen, **{"settings_folder": tmp_path / "settings"} | options))
        opened[-1].show()
        return opened[-1]

    yield open_one
    for desktop in opened:
        desktop.close()
    qtbot.waitUntil(lambda: not any(desktop.controller.background.is_busy for desktop in opened))


@pytest.fixture(autouse=True)
def no_niceness_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """A command run in this process gives way to others for good: all later tests would be slower for it."""
    monkeypatch.setattr("os.nice", lambda _: 0, raising=False)


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    """Fails a test that leaves a thread or a child process running."""
    threads_before = set(threading.enumerate())
    children_before = {child.pid for child in multiprocessing.active_children()}
    yield
    end = time.monotonic() + _GRACE_S
    while True:
        threads = [t for t in threading.enumerate() if t not in threads_before and not _is_foreign(t)]
        children = [c for c in multiprocessing.active_children() if c.pid not in children_before]
        children = [child for child in children if child.name != _SERVES_ALL]
        if not (threads or children) or time.monotonic() > end:
            break
        time.sleep(0.01)
    assert not threads, f"left running: {[t.name for t in threads]}"
    assert not children, f"left running: {[c.name for c in children]}"


def _is_foreign(thread: threading.Thread) -> bool:
    """Threads that Python only borrowed (Qt's own, seen once in a callback) are not ours to end."""
    return isinstance(thread, threading._DummyThread)
