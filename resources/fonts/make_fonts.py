"""Make the bundled fonts from the Inter 4 OpenType files: ``python make_fonts.py FOLDER_WITH_INTER``.

Three changes to the originals, all allowed by the OFL (Inter reserves no font name): only European scripts
and signs are kept; the lines of a paragraph stand further apart; and the tabular figures become the default
figures. The last cannot be done by a font feature at run time, because Qt's PDF writer loses the text of
glyphs that only a feature reaches. The family is renamed, so that an Inter
installed on the computer, with its own figures, is never taken instead.
Needs fontTools; not needed to run or install Carpus.
"""

from __future__ import annotations

import sys
from pathlib import Path

from fontTools import subset
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.transformPen import TransformPen
from fontTools.ttLib import TTFont

FACES = {
    "Inter-Regular": ("Carpus Inter", 400),
    "Inter-Medium": ("Carpus Inter", 500),
    "Inter-SemiBold": ("Carpus Inter", 600),
    "InterDisplay-Medium": ("Carpus Inter Display", 500),
    "InterDisplay-SemiBold": ("Carpus Inter Display", 600),
}
STYLE = {400: "Regular", 500: "Medium", 600: "SemiBold"}
KEPT_RANGES = (
    (0x20, 0x24F), (0x2B0, 0x2FF), (0x300, 0x36F), (0x370, 0x3FF), (0x400, 0x45F), (0x1E00, 0x1EFF),
    (0x2000, 0x206F), (0x20A0, 0x20BF), (0x2190, 0x2199), (0x2200, 0x22FF), (0x25A0, 0x25CF),
)  # fmt: skip
KEPT_FEATURES = ["kern", "mark", "ccmp", "locl"]
LINE_GAP_EM = 0.19
"""Makes 14 px text stand on lines of 20 px; Qt's labels have no other way to say so."""


def make_face(source: Path, family: str, weight: int, target: Path) -> None:
    """Write one face: tabular figures as default, European subset, new family name."""
    font = TTFont(source)
    _figures_tabular(font)
    _figures_equally_wide(font)
    options = subset.Options(layout_features=KEPT_FEATURES, name_IDs=["*"], notdef_outline=True, hinting=True)
    worker = subset.Subsetter(options)
    worker.populate(unicodes=[code for low, high in KEPT_RANGES for code in range(low, high + 1)])
    worker.subset(font)
    _rename(font, family, STYLE[weight])
    font["OS/2"].usWeightClass = weight
    if "Display" not in family:
        font["hhea"].lineGap = font["OS/2"].sTypoLineGap = round(LINE_GAP_EM * font["head"].unitsPerEm)
    font.save(target)


def _figures_tabular(font: TTFont) -> None:
    table = font["GSUB"].table
    wanted = {i for record in table.FeatureList.FeatureRecord if record.FeatureTag == "tnum"
              for i in record.Feature.LookupListIndex}  # fmt: skip
    swap: dict[str, str] = {}
    for index in wanted:
        for step in table.LookupList.Lookup[index].SubTable:
            swap.update(getattr(step, "ExtSubTable", step).mapping)
    for cmap in font["cmap"].tables:
        for code in range(ord("0"), ord("9") + 1):
            if code in cmap.cmap:
                cmap.cmap[code] = swap.get(cmap.cmap[code], cmap.cmap[code])


def _figures_equally_wide(font: TTFont) -> None:
    """Centre each tabular figure on the widest: their widths differ in the display cut of this release."""
    cmap, widths = font.getBestCmap(), font["hmtx"]
    names = [cmap[code] for code in range(ord("0"), ord("9") + 1)]
    widest = max(widths[name][0] for name in names)
    glyphs = font.getGlyphSet()
    top = font["CFF "].cff.topDictIndex[0]
    for name in names:
        width, bearing = widths[name]
        shift = (widest - width) // 2
        if width == widest:
            continue
        pen = T2CharStringPen(widest - top.Private.nominalWidthX, glyphs)
        glyphs[name].draw(TransformPen(pen, (1, 0, 0, 1, shift, 0)))
        top.CharStrings[name] = pen.getCharString(private=top.Private, globalSubrs=top.GlobalSubrs)
        widths[name] = (widest, bearing + shift)


def _rename(font: TTFont, family: str, style: str) -> None:
    names = {1: f"{family} {style}", 2: "Regular", 3: f"{family} {style} (from Inter)", 4: f"{family} {style}",
             6: f"{family.replace(' ', '')}-{style}", 16: family, 17: style}  # fmt: skip
    table = font["name"]
    table.names = [record for record in table.names if record.nameID in (0, 5, 7, 8, 9, 11, 12, 13, 14)]
    for number, text in names.items():
        table.setName(text, number, 3, 1, 0x409)
    cff = font["CFF "].cff
    cff.fontNames = [names[6]]
    top = cff.topDictIndex[0]
    top.FullName, top.FamilyName, top.Weight = names[4], family, style


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for face, (family_name, face_weight) in FACES.items():
        out = Path(__file__).parent / f"{family_name.replace(' ', '')}-{STYLE[face_weight]}.otf"
        make_face(folder / f"{face}.otf", family_name, face_weight, out)
        print(f"{out.name}: {out.stat().st_size / 1024:.0f} KiB")
