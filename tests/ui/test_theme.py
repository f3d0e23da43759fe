"""The palette's figures, recomputed from the hex values: WCAG 2 contrast and CIE76 under Machado 2009."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from carpus.ui.kit.theme import DARK, LIGHT, Tokens

MACHADO_2009 = {
    "normal": np.eye(3),
    "protan": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deutan": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritan": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
RGB_TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
TEXT_PAIRS = [
    ("text", "surface"), ("text", "soft"), ("text", "canvas"), ("text2", "surface"), ("text2", "sunken"),
    ("text2", "soft"), ("text2", "canvas"), ("accent", "surface"), ("accent", "canvas"), ("accent", "soft"),
    ("on_accent", "accent"),
    ("on_accent", "accent_hover"), ("on_accent", "accent_pressed"), ("good", "surface"), ("good", "good_soft"),
    ("warn", "surface"), ("warn", "warn_soft"), ("bad", "surface"), ("bad", "bad_soft"),
    ("on_band_warn", "band_warn"), ("on_band_bad", "band_bad"),
]  # fmt: skip
PART_PAIRS = [("border", "surface"), ("border", "canvas"), ("flexion", "surface"), ("deviation", "surface"),
              ("rotation", "surface"), ("flexion", "soft"), ("deviation", "soft")]  # fmt: skip


def linear(hex_color: str) -> np.ndarray:
    value = np.array([int(hex_color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def contrast(first: str, second: str) -> float:
    light = sorted((float(linear(color) @ (0.2126, 0.7152, 0.0722)) for color in (first, second)), reverse=True)
    return (light[0] + 0.05) / (light[1] + 0.05)


def lab(hex_color: str, eye: str) -> np.ndarray:
    seen = np.clip(MACHADO_2009[eye] @ linear(hex_color), 0.0, 1.0)
    scaled = RGB_TO_XYZ @ seen / np.array([0.95047, 1.0, 1.08883])
    f = np.where(scaled > 0.008856, np.cbrt(scaled), 7.787 * scaled + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize(("pairs", "least"), [(TEXT_PAIRS, 4.5), (PART_PAIRS, 3.0)], ids=["text", "parts"])
def test_theme_contrast_is_sufficient(tokens: Tokens, pairs: list[tuple[str, str]], least: float) -> None:
    for front, back in pairs:
        assert contrast(getattr(tokens, front), getattr(tokens, back)) >= least, (front, back)


@pytest.mark.parametrize(("tokens", "least", "least_of_bands"), [(LIGHT, 31.0, 42.0), (DARK, 44.0, 22.0)])
@pytest.mark.parametrize("eye", list(MACHADO_2009))
def test_theme_curves_and_bands_differ_with_colour_vision_deficiency(
    tokens: Tokens, least: float, least_of_bands: float, eye: str
) -> None:
    curves, bands = (
        (tokens.flexion, tokens.deviation, tokens.rotation),
        (tokens.good_soft, tokens.band_warn, tokens.band_bad),
    )
    for colors, apart in ((curves, least), (bands, least_of_bands)):
        assert (
            min(float(np.linalg.norm(a - b)) for a, b in itertools.combinations([lab(one, eye) for one in colors], 2))
            >= apart
        )
