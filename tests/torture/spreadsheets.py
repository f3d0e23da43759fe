"""Every exported table in LibreOffice set to German, Italian and English: the same numbers as Python finds there.

``python -m tests.torture.spreadsheets``. It needs ``libreoffice-calc`` (300 MB, two minutes to install), which no other
test does: those hold the tables against each region's rules, see ``tests/formats/test_spreadsheets.py``.
"""

from __future__ import annotations

import csv
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from carpus.core.formats.csv_tables import write
from carpus.core.formats.export_item import ExportItem
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect
from carpus.core.model.hand.protocols import HAND21
from carpus.core.session.reader import read_session
from carpus.ui.kit.table_file import regional_table_form
from tests.formats.takes import stored, take_of

LANGUAGES = {"de_DE": 1031, "it_IT": 1040, "en_GB": 2057}
"""As LibreOffice's filter of texts counts them."""
POINTS = replace(MACHINE_DIALECT, has_bom=True)
"""For a spreadsheet too, so that the forearm is counted as in the regions' tables, and read here without one."""


def tables(take: ExportItem, form: TableDialect, folder: Path) -> dict[str, Path]:
    """The tables of a form by what they hold."""
    files = (path for path in write(replace(take, dialect=form), folder) if path.suffix == ".csv")
    return {path.name.split(".")[1]: path for path in files}


def opened(path: Path, region: str, form: TableDialect, folder: Path) -> list[list[str]]:
    """The cells as LibreOffice has them when it opens a table in a region, numbers with all of their digits."""
    rule = f"Text - txt - csv (StarCalc):{ord(form.separator)},34,76,1,,{LANGUAGES[region]},false,true"
    back = "csv:Text - txt - csv (StarCalc):9,34,76,1,,1033,false,false"
    command = ["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", f"--infilter={rule}"]
    command += ["--convert-to", back, "--outdir", str(folder / region), str(path)]
    subprocess.run(command, check=True, capture_output=True, timeout=300)
    with (folder / region / path.name).open(encoding="utf-8-sig", newline="") as file:
        return list(csv.reader(file, delimiter="\t"))


def differences(folder: Path) -> Iterator[str]:
    """What a region's LibreOffice reads otherwise than the same table with points and commas has it."""
    take = take_of(read_session(stored(folder, HAND21, 120)), "one")
    plain = tables(take, POINTS, folder / "plain")
    for region in LANGUAGES:
        form = regional_table_form(region)
        for name, path in tables(take, form, folder / f"written-{region}").items():
            with plain[name].open(encoding="utf-8-sig", newline="") as file:
                wanted = list(csv.reader(file))
            found = opened(path, region, form, folder)
            numbers = 0
            for number, (one, other) in enumerate(zip(wanted, found, strict=True)):
                for cell, seen in zip(one, other, strict=True):
                    try:
                        same = abs(float(cell) - float(seen)) <= 1e-9 * max(abs(float(cell)), 1.0)
                        numbers += 1
                    except ValueError:
                        same = cell == seen
                    if not same:
                        yield f"{region} {name} line {number + 1}: {cell!r} is read as {seen!r}"
            print(f"{region} {name}: {len(wanted)} lines, {numbers} numbers")


if __name__ == "__main__":
    if shutil.which("soffice") is None:
        sys.exit("LibreOffice is missing: apt-get install --no-install-recommends libreoffice-calc")
    with tempfile.TemporaryDirectory() as scratch:
        wrong = list(differences(Path(scratch)))
    print("\n".join(wrong[:40]))
    sys.exit(f"{len(wrong)} cells are read otherwise" if wrong else 0)
