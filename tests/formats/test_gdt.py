"""GDT 2.1: requests as practice systems write them, results as they read them."""

from __future__ import annotations

import contextlib
import math
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path

import numpy as np
import pytest

from carpus.core.formats.gdt import (
    GdtRequest,
    GdtTest,
    build_tests,
    find_requests,
    format_result,
    parse_fields,
    parse_request,
    read_request,
    write_result,
)
from carpus.core.model.errors import CarpusFault, GdtUnreadable
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measure import summarise_values

WHEN = datetime(2026, 11, 28, 9, 5, 7)
MUSTERMANN = (
    "01380006302", "014810000177", "0178315CARPUS_1", "0178316PRAX_AIS", "014921802.10", "01092063", "014300012345",
    "0193101Mustermann", "0143102Jürg ", "017310330101945", "01031101", "0138402ALLG",
)  # fmt: skip
OLD_SYSTEM = (
    "01380006302", "014810000225", "014921802.00", "01930000000002191", "0153101Müller", "0143102Agnes",
    "017310330061922", "0213107Wannenstr. 7", "01031102", "023310679106 Freiburg", "01641110000000", "01341121000",
    "014410400000", "01041212", "0128402BDT",
)  # fmt: skip
"""As an older system writes it: version 2.0, no character set, a number of ten digits with zeros."""


def encode(lines: tuple[str, ...], encoding: str) -> bytes:
    """Return the file, each line with its true length and the record with its own."""
    bodies = [line[3:].encode(encoding) for line in lines]
    size = sum(len(body) + 5 for body in bodies)
    bodies = [b"8100%05d" % size if body.startswith(b"8100") else body for body in bodies]
    return b"".join(b"%03d%s\r\n" % (len(body) + 5, body) for body in bodies)


def with_field(field: str, line: str) -> tuple[str, ...]:
    return tuple(line if old[3:7] == field else old for old in MUSTERMANN)


PATIENT = GdtRequest(
    "12345", "Mustermann", "Jürg", date(1945, 10, 30), "male", sender="PRAX_AIS", receiver="CARPUS_1",
    device_field="ALLG", character_set="3",
)  # fmt: skip


@pytest.mark.parametrize(
    ("content", "patient"),
    [
        (encode(MUSTERMANN, "iso8859-1"), PATIENT),
        *(
            (encode(MUSTERMANN, "iso8859-1").replace(b"\r\n", b"\n").rstrip(b"\n") + end, PATIENT)
            for end in (b"", b"\r\n", b"\x1a", b"\x00\x00")
        ),
        (encode((*MUSTERMANN, "0183999ABC   "), "iso8859-1"), PATIENT),
        (encode(with_field("3101", "0163101O’Neill"), "cp1252"), replace(PATIENT, last_name="O’Neill")),
        *(
            (encode(with_field("3103", unknown), "cp1252"), replace(PATIENT, birth_date=None))
            for unknown in ("0093103", "017310300000000")
        ),
        (
            encode(OLD_SYSTEM, "cp437"),
            GdtRequest("0000002191", "Müller", "Agnes", date(1922, 6, 30), "female", device_field="BDT"),
        ),
    ],
    ids=[
        "ANSI", "line feeds", "last line end", "end of file", "filled up", "ends in blanks", "apostrophe of Windows",
        "no birth date", "birth date of zeros", "IBM PC",
    ],
)  # fmt: skip
def test_request_gives_patient_and_addresses(content: bytes, patient: GdtRequest) -> None:
    assert parse_request(content) == patient


@pytest.mark.parametrize("birth", ["31.12.1945", "1121945", "31131945"])
def test_request_with_an_invalid_birth_date_keeps_it_out_of_the_log(birth: str) -> None:
    with pytest.raises(GdtUnreadable) as caught:
        parse_request(encode(with_field("3103", f"0193103{birth}"), "cp1252"))
    assert birth not in f"{caught.value} {caught.value.detail} {caught.value.__cause__}"


DAMAGED = {
    "empty": b"",
    "text": b"Sehr geehrte Damen und Herren\r\n",
    "another record": encode(tuple(line.replace("80006302", "80006310") for line in MUSTERMANN), "cp1252"),
    "cut in a line": encode(MUSTERMANN, "cp1252")[:-20],
    "cut between lines": b"".join(encode(MUSTERMANN, "cp1252").splitlines(keepends=True)[:-1]),
    "a line's length": encode(MUSTERMANN, "cp1252").replace(b"0193101", b"0203101"),
    "two records": encode(MUSTERMANN, "cp1252") * 2,
    "no number": encode(tuple(line for line in MUSTERMANN if line[3:7] != "3000"), "cp1252"),
    "a day that is none": encode(MUSTERMANN, "cp1252").replace(b"310330101945", b"310331131945"),
    "a character set of another age": encode(tuple(line.replace("92063", "92069") for line in MUSTERMANN), "cp1252"),
}  # fmt: skip


@pytest.mark.parametrize("content", DAMAGED.values(), ids=DAMAGED.keys())
def test_request_damaged_raises_fault_that_names_the_file(content: bytes) -> None:
    with pytest.raises(GdtUnreadable) as caught:
        parse_request(content, "in.gdt")

    assert caught.value.subject == "in.gdt"
    assert caught.value.detail
    assert "Mustermann" not in str(caught.value)


def test_request_random_bytes_never_raise_anything_else() -> None:
    draws, whole = np.random.default_rng(7), encode(MUSTERMANN, "cp1252")
    for _ in range(300):
        content = bytearray(whole)
        for place in draws.integers(0, len(content), 3):
            content[place] = draws.integers(0, 256)
        with contextlib.suppress(CarpusFault):
            parse_request(bytes(content))


def test_result_read_back_has_true_lengths_and_the_request_s_addresses() -> None:
    request = parse_request(encode(MUSTERMANN, "iso8859-1"))
    tests = [GdtTest("FLEXION", "Flexion aktiv", 61.26, "°"), GdtTest("ARC", "unbekannt", math.nan, "°")]
    record = format_result(request, WHEN, tests, findings=["ä" * 70], report=Path("/reports/12345.pdf"))

    fields, character_set = parse_fields(record)
    first = dict(reversed(fields))
    assert character_set == "3"
    assert int(first["8100"]) == len(record)
    assert (first["8000"], first["8315"], first["8316"], first["3000"]) == ("6310", "PRAX_AIS", "CARPUS_1", "12345")
    assert first["3101"] == "Mustermann"
    assert first["8402"] == "ALLG"
    assert (first["8410"], first["8420"], first["8421"], first["8432"]) == ("FLEXION", "61.3", "°", "28112026")
    assert [text for identifier, text in fields if identifier == "6220"] == ["ä" * 60, "ä" * 10]
    assert first["6305"] == "/reports/12345.pdf"
    assert "unbekannt" not in {text for _, text in fields}


def test_result_with_a_long_number_has_it_whole() -> None:
    request = GdtRequest("2026-0000012345", sender="PRAXIS_AIS_1", device_field="ALLG0001")
    first = dict(reversed(parse_fields(format_result(request, WHEN, []))[0]))

    assert (first["3000"], first["8315"], first["8402"]) == ("2026-0000012345", "PRAXIS_AIS_1", "ALLG0001")


def test_result_limited_by_the_view_says_in_which_direction() -> None:
    rows = [
        replace(summarise_values("range", subject, quantity, "deg", (12.0, 14.0)), is_lower_bound=True)
        for subject, quantity in (("flexion", "extension"), ("PIP2_flexion", "flexion"), ("PIP2_flexion", "extension"))
    ]
    fields, _ = parse_fields(format_result(GdtRequest("1"), WHEN, build_tests(rows, lambda row: row.subject)))

    assert [text[:7] for field, text in fields if field == "8470"] == [">= 13.0", ">= 13.0", "<= 13.0"]


@pytest.mark.parametrize("character_set", ["1", "2", "3"])
def test_result_in_each_character_set_keeps_umlauts_and_signs_of_a_range(character_set: str) -> None:
    request = GdtRequest("1", "Größe", character_set=character_set)
    test = GdtTest("ARC", "Flexion–extension", 60.0, "°")
    fields = dict(parse_fields(format_result(request, WHEN, [test], findings=["≥40 – 0\N{NON-BREAKING HYPHEN}20"]))[0])

    assert (fields["3101"], fields["6220"], fields["8411"]) == ("Größe", ">=40 - 0-20", "Flexion-extension")


def test_result_identifiers_are_short_and_each_its_own() -> None:
    rows = [
        summarise_values("range", subject, quantity, "deg", (1.0, 2.0))
        for subject in (*WRIST_ANGLES, "MCP2_flexion", "MCP2_abduction", "PIP5_flexion", "CMC1_extension", "TAM3")
        for quantity in ("arc", "flexion", "extension")
    ]
    tests = build_tests(rows, lambda row: row.subject)
    names = [test.identifier for test in tests]

    assert all(len(name) <= 20 for name in names)
    assert len(set(names)) == len([row for row in rows if row.wrist_angle < 0 or row.quantity == "arc"]) + 2


def test_write_result_for_an_address_with_a_slash_stays_in_the_folder(tmp_path: Path) -> None:
    assert write_result(tmp_path, GdtRequest("1", sender="../A"), b"").name == "___ACARP.001"


def test_write_result_twice_takes_the_next_number(tmp_path: Path) -> None:
    request = parse_request(encode(MUSTERMANN, "iso8859-1"))
    first, second = (write_result(tmp_path, request, format_result(request, WHEN, [])) for _ in range(2))

    assert (first.name, second.name) == ("PRAXCARP.001", "PRAXCARP.002")
    assert find_requests(tmp_path) == [], "the practice system may use one folder for both"
    with pytest.raises(GdtUnreadable):
        read_request(first)
