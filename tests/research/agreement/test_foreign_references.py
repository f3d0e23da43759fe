"""References as programs and spreadsheets of others write them: the same numbers, or one sentence that says why not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carpus.core.formats.table_read import read_table
from carpus.core.model.errors import ReferenceUnreadable, ReferenceUnsuited
from carpus.core.model.hand.protocols import PALM_MARKERS
from carpus.core.model.types import FloatArray
from carpus.core.research.agreement.agreement_files import format_comparison
from carpus.core.research.agreement.compare import MAX_RESIDUAL_M, compare_session
from carpus.core.research.agreement.reference import Reference, read_reference
from carpus.core.results.session_results import compute_session_results
from tests.ui.fakes import session

TIME_S = np.arange(60) / 30.0
FLEXION_DEG = np.round(40.0 * np.sin(2.0 * TIME_S) - 5.0, 3)


def format_rows(separator: str = ",", decimal: str = ".", times: list[str] | None = None, minus: str = "-") -> str:
    said = times or [f"{t:.4f}" for t in TIME_S]
    pairs = [f"{t}{separator}{angle:.3f}" for t, angle in zip(said, FLEXION_DEG, strict=True)]
    return "".join(f"{pair.replace('.', decimal).replace('-', minus)}\n" for pair in pairs)


CLOCK = [f"23:59:{59 + t:06.3f}" if t < 1.0 else f"00:00:{t - 1.0:06.3f}" for t in TIME_S]
TABLES = {
    "plain": "time,flexion\n" + format_rows(),
    "blank after the comma": "time, flexion\n" + format_rows(", "),
    "sep": "sep=;\ntime;flexion\n" + format_rows(";", ","),
    "lines before": "Some Logger\nOperator,Jones\nRate,30\nTrial,3\n\ntime,flexion\n" + format_rows(),
    "units": "Zeit (s);Flexion (°)\n" + format_rows(";", ","),
    "units below": "time,flexion\ns,deg\n" + format_rows(),
    "milliseconds": "Time [ms];flexion\n" + format_rows(";", times=[f"{1e3 * t:.1f}" for t in TIME_S]),
    "milliseconds unsaid": "time;flexion\n" + format_rows(";", times=[f"{1e3 * t:.1f}" for t in TIME_S]),
    "clock past midnight": "time,flexion\n" + format_rows(times=CLOCK),
    "dates": "time,flexion_deg\n"
    + format_rows(times=[f"2026-11-20 10:00:{t:09.6f}" for t in TIME_S]).replace("−", "-"),
    "minus": "time,flexion\n" + format_rows(minus="\N{MINUS SIGN}"),
    "tabs": "time\tflexion\tnote\n" + format_rows("\t", ","),
}


def read_text(folder: Path, text: str, encoding: str = "utf-8") -> Reference:
    (folder / "r.csv").write_bytes(text.encode(encoding))
    return read_reference(folder / "r.csv")


@pytest.mark.parametrize("name", TABLES)
def test_reference_table_forms_read_alike(name: str, tmp_path: Path) -> None:
    found = read_text(tmp_path, TABLES[name])
    assert np.degrees(found.angles_rad["flexion"]) == pytest.approx(FLEXION_DEG)
    assert found.time_s - found.time_s[0] == pytest.approx(TIME_S, abs=6e-4)
    assert len(found.remarks) == (name in ("milliseconds unsaid", "units below"))


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
def test_reference_table_encodings_are_read(encoding: str, tmp_path: Path) -> None:
    found = read_text(tmp_path, TABLES["units"], encoding)
    assert np.degrees(found.angles_rad["flexion"]) == pytest.approx(FLEXION_DEG)


def test_reference_row_with_equal_time_is_excluded(tmp_path: Path) -> None:
    text = TABLES["plain"].splitlines()
    found = read_text(tmp_path, "\n".join([*text[:4], text[3], *text[4:]]))
    assert len(found.time_s) == len(TIME_S)
    assert "excluded (1)" in found.remarks[0]


@pytest.mark.parametrize(
    ("head", "told"),
    [
        ("time,flexion,flexion", "flexion #1, flexion #2 found for flexion"),
        ("time,flexion (left),Flexion", "flexion (left), Flexion"),
        ("when,flexion,other", "which of when, flexion, other"),
    ],
)
def test_reference_ambiguous_names_are_listed(head: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(ReferenceUnreadable, match=told.replace("(", r"\(").replace(")", r"\)")):
        read_text(tmp_path, head + "\n" + "0,1,2\n0.1,2,3\n")


@pytest.mark.parametrize(
    ("left", "right"),
    [("flexion_l", "flexion_r"), ("wrist_flexion_left", "Right:Flexion"), ("Flexion links (°)", "Flexion rechts (°)")],
)
def test_reference_columns_of_both_hands_use_the_session_hand(left: str, right: str, tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_text(f"time,{left},{right}\n0,1,20\n0.1,2,30\n", encoding="utf-8")
    for hand, first in (("left", 1.0), ("right", 20.0)):
        found = read_reference(tmp_path / "r.csv", hand=hand)  # type: ignore[arg-type]
        assert np.degrees(found.angles_rad["flexion"][0]) == pytest.approx(first)
        assert "both hands" in found.remarks[0]
    with pytest.raises(ReferenceUnreadable, match=f"{left}, {right}".replace("(", r"\(").replace(")", r"\)")):
        read_reference(tmp_path / "r.csv")


def write_trc(path: Path, time_s: FloatArray, markers: dict[str, FloatArray]) -> Path:
    """Markers (K, 3) in mm as OpenSim has them."""
    head = [
        "PathFileType\t4\t(X/Y/Z)\tr.trc",
        "DataRate\tUnits",
        "30\tmm",
        "Frame#\tTime\t" + "\t\t\t".join(markers),
        "\t",
    ]
    places = np.hstack(list(markers.values()))
    body = [
        "\t".join(map(str, (k + 1, t, *row))) for k, (t, row) in enumerate(zip(time_s, places.tolist(), strict=True))
    ]
    path.write_text("\n".join([*head, "", *body]) + "\n", encoding="utf-8")
    return path


def test_reference_points_of_two_hands_with_zero_gaps_are_read(tmp_path: Path) -> None:
    made = session(seconds=26.0)
    time_s = made.timestamp_s - made.timestamp_s[0]
    own = {name: 1e3 * made.markers.position_cam_m[:, k] for k, name in enumerate(PALM_MARKERS)}
    both = {f"R:{name}": place.copy() for name, place in own.items()} | {
        f"L:{name}": 0.5 * place[::-1] for name, place in own.items()
    }
    both["R:MCP2"][40] = 0.0
    path = write_trc(tmp_path / "r.trc", time_s, both)
    found = read_reference(path, hand="right")
    assert np.isnan(found.points_m["MCP2"]).all(axis=1).nonzero()[0].tolist() == [40]
    compared = compare_session(made, found)
    assert compared.alignment is not None
    assert compared.alignment.residual_m < 1e-4
    assert "R:WRIST" in compared.remarks[0]
    with pytest.raises(ReferenceUnreadable, match="R:WRIST, L:WRIST found for WRIST"):
        read_reference(path)
    both["R:MCP3"][:] = 0.0
    never = read_reference(write_trc(tmp_path / "never.trc", time_s, both), hand="right")
    assert set(PALM_MARKERS) - set(never.points_m) == {"MCP3"}
    chosen = read_reference(path, markers={name: f"L:{name}" for name in PALM_MARKERS})
    assert chosen.points_m["WRIST"] == pytest.approx(both["L:WRIST"] / 1e3, nan_ok=True)
    with pytest.raises(ReferenceUnreadable, match="no marker R:PALM, only R:WRIST"):
        read_reference(path, markers={"WRIST": "R:PALM"})


def test_compare_residual_between_markers_is_remarked(tmp_path: Path) -> None:
    made = session(seconds=26.0)
    own = {name: 1e3 * made.markers.position_cam_m[:, k] for k, name in enumerate(PALM_MARKERS)}
    own["MCP2"], own["MCP5"] = own["MCP5"], own["MCP2"]
    path = write_trc(tmp_path / "r.trc", made.timestamp_s - made.timestamp_s[0], own)
    compared = compare_session(made, read_reference(path), lag_s=0.0)
    assert compared.alignment is not None
    assert compared.alignment.residual_m > MAX_RESIDUAL_M
    assert any("mm apart" in remark for remark in compared.remarks)


def test_compare_two_readings_print_pairs(tmp_path: Path) -> None:
    made, count = session(seconds=26.0), 2
    text = "movement;reading (°)\n" + "flexion;47,5\nextension;49\n".splitlines(keepends=True)[0] * count
    compared = compare_session(made, read_text(tmp_path, text), figures=compute_session_results(made))
    said = "\n".join(format_comparison(compared))
    assert said.count("47.50") == count
    assert "nan" not in said.lower()
    assert "fewer than 3 pairs" in said


def test_reference_without_angles_lists_its_columns(tmp_path: Path) -> None:
    with pytest.raises(ReferenceUnsuited, match="only Knie, Hüfte"):
        compare_session(session(seconds=26.0), read_text(tmp_path, "Zeit;Knie;Hüfte\n0,0;1;2\n0,1;2;3\n", "cp1252"))


def test_reference_table_separators_are_read(tmp_path: Path) -> None:
    (tmp_path / "t.csv").write_text("\ufeffPerson;Session;Reference\n1;s 1.h5;r,1.csv\n", encoding="utf-8")
    table = read_table(tmp_path / "t.csv", ("person", "session", "reference"))
    assert table.row(0) == {"person": "1", "session": "s 1.h5", "reference": "r,1.csv"}
