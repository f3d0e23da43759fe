"""GDT 2.1: requests of a practice system for a measurement, and the results that go back.

A record is one file of lines: three digits for the length of the line in bytes with its CR LF, four for the field, then
its content.
Source: QMS, *Gerätedatentransfer, Satzbeschreibung 2.1*.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path
from typing import Literal

from carpus.core.formats.output_files import open_new_file
from carpus.core.model.errors import GdtUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.results.measure import Comparator, Measure

RECORD_TYPE, RECORD_LENGTH, CHARACTER_SET, VERSION = "8000", "8100", "9206", "9218"
RECEIVER, SENDER, DEVICE_FIELD = "8315", "8316", "8402"
TEST, TEST_NAME, VALUE, UNIT, TEST_DATE, TEST_TIME, TEST_NOTE = "8410", "8411", "8420", "8421", "8432", "8439", "8470"
PATIENT_NUMBER, LAST_NAME, FIRST_NAME, BIRTH_DATE, SEX = "3000", "3101", "3102", "3103", "3110"
REQUEST_TYPES = ("6302", "6301")
"""“Request a new examination” and “transfer patient data”, which some systems send for both."""
RESULT_TYPE = "6310"
DEFAULT_CHARACTER_SET = "2"
ENCODINGS = {"1": "iso646-de", "2": "cp437", "3": "cp1252"}
"""Python's encoding of each character set; without a field 9206 it is that of the IBM PC. Systems on Windows write its
letters, such as the apostrophe of O’Neill, where the specification has ISO 8859-1."""
_ISO646_DE = str.maketrans("[\\]{|}~@", "ÄÖÜäöüß§")
_PLAIN_SIGNS = str.maketrans({
    "\N{EN DASH}": "-", "\N{NON-BREAKING HYPHEN}": "-", "\N{MINUS SIGN}": "-",
    "\N{GREATER-THAN OR EQUAL TO}": ">=", "\N{LESS-THAN OR EQUAL TO}": "<=",
})  # fmt: skip
"""Signs of Carpus's own words that no or not every character set has."""
_FILE_NAME = re.compile(r"[^.].*\.(gdt|\d{3})", re.IGNORECASE)
_LINE_OVERHEAD = 9
_MAX_TEXT = 60
"""Characters of a field of text; longer ones are continued in another field of the same identifier."""
_MAX_LENGTHS = {LAST_NAME: 28, FIRST_NAME: 28, TEST: 20}
"""Not of numbers and addresses, which go back as they came: a shorter number may be another patient's."""
_PADDING = b"\x1a\x00"
_SHORT_QUANTITIES = {"flexion": "max", "extension": "min"}

Sex = Literal["", "male", "female"]
_SEX_CODES: dict[str, Sex] = {"1": "male", "2": "female"}


@dataclass(frozen=True, slots=True)
class GdtRequest:
    """Patient whom a practice system sends to be measured.

    ``sender`` and ``receiver`` are the GDT identifiers of both programs; ``device_field`` (8402) goes back unchanged.
    """

    number: str
    last_name: str = ""
    first_name: str = ""
    birth_date: date | None = None
    sex: Sex = ""
    sender: str = ""
    receiver: str = ""
    device_field: str = ""
    character_set: str = DEFAULT_CHARACTER_SET


@dataclass(frozen=True, slots=True)
class GdtTest:
    """One result: short identifier, name and value with its unit; NaN is not sent."""

    identifier: str
    name: str
    value: float
    unit: str
    comparator: Comparator = ""


def parse_fields(content: bytes, name: str = "") -> tuple[list[tuple[str, str]], str]:
    """Return the fields (identifier, content) of the record in a file, and its character set.

    Raises :class:`GdtUnreadable` for lines that are not of the format, of another length than they state, or fewer
    than the record states; ``name`` of the file is for its sentence.
    """
    lines = content.rstrip(_PADDING).replace(b"\r\n", b"\n").split(b"\n")
    while len(lines) > 1 and not lines[-1].strip(_PADDING + b" "):
        lines.pop()
    raw: list[tuple[str, bytes]] = []
    for number, line in enumerate(lines, 1):
        length, identifier = line[:3], line[3:7]
        if not (length.isdigit() and identifier.isdigit() and len(identifier) == 4):
            raise GdtUnreadable(name, phrase("line {number} is not a GDT line").format(number=number))
        if int(length) != len(line) + 2:
            raise GdtUnreadable(name, phrase("line {number}: length differs from the stated one").format(number=number))
        if identifier == RECORD_TYPE.encode() and raw:
            raise GdtUnreadable(name, phrase("it contains more than one record"))
        raw.append((identifier.decode(), line[7:]))
    if raw[0][0] != RECORD_TYPE:
        raise GdtUnreadable(name, phrase("no record type at the start"))
    stated = next((text for identifier, text in raw if identifier == RECORD_LENGTH), b"")
    size = sum(len(text) + _LINE_OVERHEAD for _, text in raw)
    if stated.strip().isdigit() and size < int(stated):
        raise GdtUnreadable(name, phrase("end missing"))
    character_set = next((text for identifier, text in raw if identifier == CHARACTER_SET), b"").decode(
        "ascii", "replace"
    )
    character_set = character_set.strip() or DEFAULT_CHARACTER_SET
    if character_set not in ENCODINGS:
        raise GdtUnreadable(name, phrase("unknown character set {number}").format(number=character_set))
    return [(identifier, _decode(text, character_set)) for identifier, text in raw], character_set


def _decode(text: bytes, character_set: str) -> str:
    if character_set == "1":
        return text.decode("ascii", "replace").translate(_ISO646_DE)
    return text.decode(ENCODINGS[character_set], "replace")


def read_request(path: Path) -> GdtRequest:
    """Read the patient of a request. Raises :class:`GdtUnreadable`."""
    try:
        content = path.read_bytes()
    except OSError as cause:
        raise GdtUnreadable(path.name, cause.strerror or "") from cause
    return parse_request(content, path.name)


def parse_request(content: bytes, name: str = "") -> GdtRequest:
    """Return the patient of a request. Raises :class:`GdtUnreadable`.

    A birth date of zeros is unknown; a sex other than 1 or 2 too.
    """
    fields, character_set = parse_fields(content, name)
    first = {identifier: text.strip() for identifier, text in reversed(fields)}
    if first[RECORD_TYPE] not in REQUEST_TYPES:
        detail = phrase("record type {number}, 6302 or 6301 expected").format(number=first[RECORD_TYPE])
        raise GdtUnreadable(name, detail)
    if not first.get(PATIENT_NUMBER):
        raise GdtUnreadable(name, phrase("no patient number"))
    return GdtRequest(
        first[PATIENT_NUMBER],
        first.get(LAST_NAME, ""),
        first.get(FIRST_NAME, ""),
        _parse_date(first.get(BIRTH_DATE, ""), name),
        _SEX_CODES.get(first.get(SEX, ""), ""),
        sender=first.get(SENDER, ""),
        receiver=first.get(RECEIVER, ""),
        device_field=first.get(DEVICE_FIELD, ""),
        character_set=character_set,
    )


def _parse_date(text: str, name: str) -> date | None:
    if not text.strip("0"):
        return None
    if len(text) == 8:  # of seven digits it is not known where the month begins
        with suppress(ValueError):
            return datetime.strptime(text, "%d%m%Y").date()
    raise GdtUnreadable(name, phrase("invalid birth date"))  # which is not for the log


def build_tests(measures: Iterable[Measure], describe: Callable[[Measure], str]) -> list[GdtTest]:
    """Return ranges of motion (means) as results; ``describe`` names a measure in the clinic's language."""
    return [
        GdtTest(_identify(row), describe(row), row.mean, row.unit.replace("deg", "°"), row.comparator)
        for row in measures
        if row.group == "range" and math.isfinite(row.mean)
    ]


def _identify(row: Measure) -> str:
    """Return the identifier of a measure, of at most 20 characters."""
    joint, _, kind = row.subject.partition("_")
    parts = [joint, "" if kind == "flexion" else kind[:3], _SHORT_QUANTITIES.get(row.quantity, row.quantity)]
    if row.wrist_angle >= 0 and row.quantity != "arc":
        parts = [row.quantity]
    if row.is_passive:
        parts.insert(0, "p")
    return " ".join(filter(None, parts)).upper()[: _MAX_LENGTHS[TEST]]


def format_result(
    request: GdtRequest,
    when: datetime,
    tests: Sequence[GdtTest],
    *,
    findings: Sequence[str] = (),
    report: Path | None = None,
) -> bytes:
    """Return the record 6310 that answers a request.

    ``findings`` are lines of text for the patient's file; ``report`` is the PDF that the record refers to. Letters that
    the character set lacks become a question mark, and longer texts are cut at the length of their field or continued.
    """
    day, time = when.strftime("%d%m%Y"), when.strftime("%H%M%S")
    fields = [
        (RECORD_TYPE, RESULT_TYPE),
        (RECORD_LENGTH, "00000"),
        *((identifier, text) for identifier, text in ((RECEIVER, request.sender), (SENDER, request.receiver)) if text),
        (CHARACTER_SET, request.character_set),
        (VERSION, "02.10"),
        (PATIENT_NUMBER, request.number),
        *((identifier, text) for identifier, text in (
            (LAST_NAME, request.last_name),
            (FIRST_NAME, request.first_name),
            (BIRTH_DATE, request.birth_date.strftime("%d%m%Y") if request.birth_date else ""),
            (SEX, {sex: code for code, sex in _SEX_CODES.items()}.get(request.sex, "")),
            (DEVICE_FIELD, request.device_field),
        ) if text),
        ("6200", day),
        ("6201", time),
        *(("6220", part) for line in findings for part in _split_text(line.translate(_PLAIN_SIGNS))),
    ]  # fmt: skip
    if report is not None:
        fields += [("6302", "000001"), ("6303", "PDF"), ("6304", "Carpus"), ("6305", str(report))]
    for test in tests:
        if math.isfinite(test.value):
            name = test.name.translate(_PLAIN_SIGNS)[:_MAX_TEXT]
            fields += [(TEST, test.identifier), (TEST_NAME, name), (VALUE, f"{test.value:.1f}")]
            fields += [(UNIT, test.unit), (TEST_DATE, day), (TEST_TIME, time)]
            fields += [(TEST_NOTE, f"{test.comparator} {test.value:.1f} {test.unit}")] if test.comparator else []
    lines = [
        (identifier, _encode(text[: _MAX_LENGTHS.get(identifier, 990)], request.character_set))
        for identifier, text in fields
    ]
    size = sum(len(text) + _LINE_OVERHEAD for _, text in lines)
    lines[1] = (RECORD_LENGTH, b"%05d" % size)
    return b"".join(
        b"%03d%s%s\r\n" % (len(text) + _LINE_OVERHEAD, identifier.encode(), text) for identifier, text in lines
    )


def find_requests(folder: Path) -> list[Path]:
    """Return the GDT files in a folder but results, oldest first: ``NAME.gdt``, or numbered ``NAME.001``.

    Results for the practice system may lie in the same folder.
    """
    found = [path for path in folder.iterdir() if _FILE_NAME.fullmatch(path.name)]
    return sorted((path for path in found if not _is_result(path)), key=lambda path: path.stat().st_mtime)


def _is_result(path: Path) -> bool:
    with suppress(OSError), path.open("rb") as file:
        return file.read(11)[3:] == f"{RECORD_TYPE}{RESULT_TYPE}".encode()
    return False


def write_result(folder: Path, request: GdtRequest, record: bytes) -> Path:
    """Write a record under the next free number, complete or not at all; return its path.

    The name has four letters of the receiver and four of the sender, as the specification asks. Raises
    :class:`OutputExists` if all numbers are taken, :class:`OutputNotWritable` or :class:`DiskFull`.
    """
    stem = f"{(request.sender or 'PVS')[:4]:_<4}{(request.receiver or 'CARPUS')[:4]:_<4}".upper()
    stem = re.sub(r"\W", "_", stem)  # an address may have a slash
    numbered = (folder / f"{stem}.{number:03d}" for number in range(1, 1000))
    path = next((path for path in numbered if not path.exists()), folder / f"{stem}.999")
    with open_new_file(path) as file:
        file.write(record)
    return path


def _split_text(text: str) -> list[str]:
    return [text[begin : begin + _MAX_TEXT] for begin in range(0, len(text), _MAX_TEXT)]


def _encode(text: str, character_set: str) -> bytes:
    if character_set == "1":
        back = {letter: code for code, letter in _ISO646_DE.items()}
        return text.translate(back).encode("ascii", "replace")
    return text.encode(ENCODINGS[character_set], "replace")
