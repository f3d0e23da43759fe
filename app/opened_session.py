"""A session as Python users have it: arrays, tables, labelled arrays and a figure; many sessions as one table."""

from __future__ import annotations

import base64
import html
import io
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from carpus.app.session_commands import log_session_action, read_choices, read_results
from carpus.core.model.errors import CarpusFault, ExtraMissing, SettingsInvalid
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.session import session_file
from carpus.core.session.values import Motion, Session

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from carpus.core.formats.measures_table import MeasureRow
    from carpus.core.results.session_results import SessionResults

Estimate = Literal["best", "filter", "smoother"]
BAND_SDS = 1.96
"""A band of 95 % to both sides of an angle."""
_UNIT_BY_SUFFIX = {"_deg_s": "deg/s", "_mm_s": "mm/s", "_deg": "deg", "_mm": "mm", "_px": "px", "_s": "s"}


@dataclass(frozen=True, slots=True, repr=False)
class OpenedSession(Session):
    """A session with tables, measures and provenance beside its arrays.

    Data frames, labelled arrays and figures need the extra ``carpus[research]``.
    """

    def __repr__(self) -> str:
        from carpus.core.results.session_summary import identity_lines

        return "\n".join(
            line for line in identity_lines(self) if not line.startswith(("Identity", "Created", "Recording"))
        )

    def _repr_html_(self) -> str:
        text = f"<pre>{html.escape(repr(self))}</pre>"
        try:
            figure = _import_extra("matplotlib.figure").Figure(figsize=(7.0, 2.5), layout="constrained")
        except ExtraMissing:
            return text
        self.plot(ax=figure.subplots())
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=72)
        return f'{text}<img alt="Angles" src="data:image/png;base64,{base64.b64encode(picture.getvalue()).decode()}">'

    @property
    def angle_names(self) -> tuple[str, ...]:
        """Names of all angles: those of the wrist, then the joints'."""
        return (*WRIST_ANGLES, *self.header.joint_names)

    def angles_deg(self, estimate: Estimate = "best") -> tuple[FloatArray, FloatArray]:
        """Return all angles and their standard deviations.

        Parameters
        ----------
        estimate : {"best", "filter", "smoother"}
            The best is the smoother's where it ran.

        Returns
        -------
        ndarray, ndarray, both (N, number of angles)
            In degrees, NaN where unknown, in the order of :attr:`angle_names`.
        """
        if estimate not in ("best", "filter", "smoother"):
            raise SettingsInvalid("carpus", f"estimate is {estimate!r}, 'best', 'filter' or 'smoother' expected")
        motion: Motion | None = self.motion if estimate == "filter" else self.smoothed
        if motion is None:
            if estimate == "smoother":
                raise SettingsInvalid("carpus", "estimate is 'smoother', which did not run for this session")
            motion = self.motion
        values = np.hstack((motion.angles_rad, motion.joint_angles_rad))
        sds = np.hstack((motion.angles_sd_rad, motion.joint_angles_sd_rad))
        return np.degrees(values), np.degrees(sds)

    def to_dataframe(self, estimate: Estimate = "best") -> DataFrame:
        """Return status, angles and their standard deviations, one row a frame.

        Returns
        -------
        DataFrame
            Columns ``status``, ``flexion_deg``, ``flexion_sd_deg`` and so on; the index is the time after the first
            frame, ``attrs["units"]`` has the unit of each column.
        """
        columns: dict[str, Any] = {"timestamp_s": self.timestamp_s, "status": self._status_names()}
        for name, value, sd in zip(self.angle_names, *(each.T for each in self.angles_deg(estimate)), strict=True):
            columns |= {f"{name}_deg": value, f"{name}_sd_deg": sd}
        return _to_data_frame(columns, self).drop(columns="timestamp_s")

    def to_xarray(self, estimate: Estimate = "best") -> Dataset:
        """Return the session as labelled arrays over time.

        Returns
        -------
        Dataset
            A variable for each angle and its sd (``time``), ``marker_position`` (``time``, ``marker``, ``axis``) in
            the axes of the colour camera, ``marker_visible`` and ``status``. Attributes ``units`` and ``long_name``.
        """
        xarray = _import_extra("xarray")
        from carpus.core.formats.export_item import is_measured
        from carpus.core.formats.measures_table import positive_direction

        arrays: dict[str, Any] = {"status": ("time", self._status_names(), {"long_name": "tracking status"})}
        for name, value, sd in zip(self.angle_names, *(each.T for each in self.angles_deg(estimate)), strict=True):
            said = {"units": "deg", "long_name": name.replace("_", " "), "positive": positive_direction(name)}
            arrays[name] = ("time", value, said)
            arrays[f"{name}_sd"] = ("time", sd, {"units": "deg", "long_name": f"standard deviation of {name}"})
        place_mm = 1e3 * self.markers.position_cam_m
        arrays["marker_position"] = (("time", "marker", "axis"), place_mm, {"units": "mm", "long_name": "position"})
        arrays["marker_visible"] = (("time", "marker"), is_measured(self))
        time_s = ("time", self._elapsed_s(), {"units": "s", "long_name": "time after the first frame"})
        coordinates = {"time": time_s, "marker": list(self.header.protocol.markers), "axis": list("xyz")}
        header = self.header
        about = {
            "session_id": header.session_id, "subject_id": header.subject_id, "hand": header.hand,
            "exercise": header.exercise, "recorded": header.recorded, "simulated": int(header.is_simulated),
        }  # fmt: skip
        found: Dataset = xarray.Dataset(arrays, coordinates, about)
        return found

    def plot(self, angles: Sequence[str] = (), ax: Axes | None = None) -> Axes:
        """Draw angles over time with bands of 95 % and the repetitions.

        Parameters
        ----------
        angles : sequence of str
            Names of :attr:`angle_names`; the trained angle, or those of the wrist, without it.
        ax : Axes, optional
            Where to draw; a new figure without it.
        """
        results = self._results()
        from carpus.core.results.repetition_rows import trained_angle_name

        trained = trained_angle_name(self)
        named = [angles] if isinstance(angles, str) else list(angles) or ([trained] if trained else [*WRIST_ANGLES])
        for name in named:
            if name not in self.angle_names:
                raise SettingsInvalid(
                    "carpus", f"there is no angle called {name!r}; there are {', '.join(self.angle_names)}"
                )
        axes: Axes = _import_extra("matplotlib.pyplot").subplots(layout="constrained")[1] if ax is None else ax
        time_s, (values, sds) = self._elapsed_s(), self.angles_deg()
        for name in named:
            value, sd = (each[:, self.angle_names.index(name)] for each in (values, sds))
            (line,) = axes.plot(time_s, value, label=name.replace("_", " "))
            axes.fill_between(
                time_s, value - BAND_SDS * sd, value + BAND_SDS * sd, color=line.get_color(), alpha=0.25, linewidth=0.0
            )
        for one in results.repetitions:
            axes.axvspan(one.start_s, one.end_s, alpha=0.1 if one.is_counted else 0.03, color="0.3")
        axes.set(xlabel="Time (s)", ylabel="Angle (°)", title=f"{self.path.stem}, bands 95 %, repetitions shaded")
        axes.legend(loc="upper right")
        return axes

    def tables(self) -> dict[str, DataFrame]:
        """Return ``wrist``, ``joints``, ``markers``, ``events``, ``repetitions`` and ``measures``.

        Returns
        -------
        dict of str to DataFrame
            Tidy, NaN for unknown values. Tables over time have the time after the first frame as their index
            (:class:`pandas.TimedeltaIndex`); ``attrs["units"]`` has the unit of each column.
        """
        from carpus.core.formats.csv_tables import build_repetition_table, build_tables

        results = self._results()
        found: dict[str, Any] = dict(build_tables(self)) | {"repetitions": build_repetition_table(self, results)}
        tables = {name: _to_data_frame(columns, self) for name, columns in found.items()}
        return tables | {"measures": _measures_frame(self.measures())}

    def measures(self) -> tuple[MeasureRow, ...]:
        """Return all measures; ``key`` names one without spaces, ``label`` for people.

        Repetitions that were excluded or moved in the review count as they are stored beside the file.
        """
        from carpus.core.formats.measures_table import build_measure_rows

        return build_measure_rows(self._results(), self.path.stem)

    def provenance(self) -> Mapping[str, Any]:
        """Return the origin of the data and the software and settings that made them."""
        from carpus.core.formats.export_provenance import build_provenance

        return build_provenance(self)

    def _results(self) -> SessionResults:
        from carpus.core.results.session_results import compute_session_results

        return compute_session_results(self, read_choices(self.path))

    def _elapsed_s(self) -> FloatArray:
        return self.timestamp_s - self.timestamp_s[:1]

    def _status_names(self) -> np.ndarray:
        return np.array([status.name.lower() for status in sorted(TrackStatus)])[self.status]


def check_path(where: str, name: str, value: object) -> Path:
    """Return ``value`` as a path. Raises :class:`SettingsInvalid`."""
    if not isinstance(value, (str, Path)) or "\0" in str(value):
        raise SettingsInvalid(where, f"{name} is {value!r}, a path expected")
    return Path(value)


def show_warning(fault: CarpusFault) -> None:
    """Warn the caller of a fault that ends nothing."""
    warnings.warn(format_fault_line(fault), stacklevel=2)


def open_session(path: str | Path) -> OpenedSession:
    """Open a session file; the file is never changed.

    It is read in this process, so a damaged file can hang it; ``carpus verify`` looks at one from outside. The opening
    of a session in a data folder is written into the folder's log.
    """
    session = session_file.read_session(check_path("carpus.open_session", "path", path))
    log_session_action("opened", session.path, session.header.session_id)
    return OpenedSession(**{field.name: getattr(session, field.name) for field in fields(Session)})


def open_sessions(folder: str | Path | Sequence[str | Path]) -> DataFrame:
    """Return the measures of all sessions of a study as one tidy table.

    Parameters
    ----------
    folder : path or sequence of paths
        Session files, or folders that are searched for them. Of several results of one recording the newest counts; a
        file that cannot be read is warned of.

    Returns
    -------
    DataFrame
        One row for each session and measure: the columns of :class:`MeasureRow`, with ``key`` and ``label`` of the
        measure; ``recorded`` is a time.
    """
    from carpus.core.formats.measures_table import build_measure_rows
    from carpus.core.results.progress import select_latest_versions

    given = [folder] if isinstance(folder, (str, Path)) else folder
    found = read_results([Path(one) for one in given], show_warning)
    for path, one in found:
        log_session_action("opened", path, one.session_id)
    names = {id(one): path.stem for path, one in found}
    latest = select_latest_versions([one for _, one in found])
    return _measures_frame([row for one in latest for row in build_measure_rows(one, names[id(one)])])


def _measures_frame(rows: Sequence[MeasureRow]) -> DataFrame:
    pandas = _import_extra("pandas")
    from carpus.core.formats.measures_table import MeasureRow

    records = [asdict(row) | {"key": row.key, "label": row.label} for row in rows]
    columns = [*(field.name for field in fields(MeasureRow)), "key", "label"]
    frame: DataFrame = pandas.DataFrame(records, columns=columns)
    frame["recorded"] = pandas.to_datetime(frame["recorded"], utc=True)
    return frame


def _to_data_frame(columns: Mapping[str, Any], session: Session) -> DataFrame:
    """Return a table as a data frame, indexed by time where it has times."""
    pandas = _import_extra("pandas")
    frame: DataFrame = pandas.DataFrame(columns)
    frame.attrs["units"] = {
        name: unit
        for name in frame.columns
        if (unit := next((unit for end, unit in _UNIT_BY_SUFFIX.items() if name.endswith(end)), ""))
    }
    if "timestamp_s" in columns or "start_s" in columns:
        first_s = session.timestamp_s[0] if len(session) else 0.0
        after_s = columns["timestamp_s"] - first_s if "timestamp_s" in columns else columns["start_s"]
        frame.index = pandas.to_timedelta(np.round(np.asarray(after_s, dtype=np.float64), 6), unit="s").rename("time")
    return frame


def _import_extra(name: str) -> Any:
    """Import a package of the extra for researchers. Raises :class:`ExtraMissing`."""
    try:
        return import_module(name)
    except ModuleNotFoundError as cause:
        fault = ExtraMissing(name.partition(".")[0])
        fault.add_note("All that notebooks need: pip install 'carpus[research]'")
        raise fault from cause
