"""The compiled functions: the numbers they gave before, from arrays stored in any way, and of fitting sizes only."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import cv2
import numpy as np

from carpus.core.detection.blobs import find_components
from tests.compiled.steps import (
    PLACE,
    draw_mask,
    draw_steps,
    find_array_paths,
    find_arrays,
    project,
    radius_at,
    replace_at,
    run_step,
)

NEAREST = 1e-9
FREE = {
    ("compute_palm_transition", 0, "scales"), ("find_blobs", 0), ("mask_paper", 0), ("sample_discs", 0),
    ("sample_discs", 2), ("sample_outline", 0), ("sample_outline", 2),
}  # fmt: skip
"""Arrays that may have any number of rows or columns."""


def every_second(array: np.ndarray) -> np.ndarray:
    """The same numbers, every second of a larger array's; between them they stand in reverse."""
    wide = np.repeat(array[..., ::-1], 2, axis=-1)
    wide[..., ::2] = array
    return wide[..., ::2]


def freeze(array: np.ndarray) -> np.ndarray:
    out = array.copy()
    out.flags.writeable = False
    return out


def vary_arrays() -> Iterator[tuple[tuple[Any, ...], np.ndarray, Callable[[np.ndarray], Any]]]:
    """Each array that a function is handed: its place, itself, and what results with another one there."""
    seen = set()
    for function, given in draw_steps().values():
        for path, array in find_array_paths(given):
            place = (function.__name__, *path)
            if array.size and place not in seen:
                seen.add(place)
                yield place, array, lambda other, f=function, g=given, at=path: f(*replace_at(g, at, other))


def test_steps_of_drawn_numbers_give_those_of_before() -> None:
    with np.load(PLACE) as expected:
        found = {name: project(run_step(step)) for name, step in draw_steps().items()}
        others = [
            name
            for name, numbers in found.items()
            if numbers.shape != expected[name].shape or not np.allclose(numbers, expected[name], NEAREST, NEAREST)
        ]
        assert (others, set(found) ^ set(expected)) == ([], set())


def test_arrays_stored_otherwise_give_the_same_or_are_refused() -> None:
    for place, array, call in vary_arrays():
        with np.errstate(invalid="ignore"):
            expected = find_arrays(call(array))
            for layout in (np.asfortranarray, every_second, freeze):
                try:
                    found = find_arrays(call(layout(array)))
                except ValueError:
                    assert layout is not freeze, place  # a table that has to be contiguous
                    continue
                for one, other in zip(found, expected, strict=True):
                    np.testing.assert_allclose(one, other, rtol=NEAREST, atol=NEAREST, err_msg=str(place))


def test_arrays_of_another_size_or_type_are_refused_if_they_are_read() -> None:
    for place, array, call in vary_arrays():
        expected = find_arrays(call(array))
        for other in () if place in FREE else (array[..., :-1], array[:-1], array.astype(np.float32)):
            try:
                found = find_arrays(call(other.copy()))
            except (ValueError, IndexError):
                continue
            for one, true in zip(found, expected, strict=True):
                np.testing.assert_allclose(one, true, rtol=1e-3, atol=1e-4, err_msg=str(place))


def test_whole_blobs_are_those_of_opencv() -> None:
    mask = draw_mask("discs", 0.5)
    _, labels, stats, middle = cv2.connectedComponentsWithStats(mask, connectivity=8)
    found = find_components(mask, lambda place: np.full(len(place), 1e3))
    row, column = np.nonzero(mask)
    same = labels[row, column] - 1
    of = found.labels[row, column] - 1
    assert len(stats) - 1 == found.label.size == np.unique(of).size
    np.testing.assert_array_equal(found.area_px[of], stats[1:, cv2.CC_STAT_AREA][same])
    np.testing.assert_array_equal(found.centre_px[of], middle[1:][same])


def test_blobs_beyond_16_bit_count_are_found() -> None:
    mask = np.zeros((600, 1000), dtype=np.uint8)
    mask[::2, ::2] = 1
    assert find_components(mask, radius_at).label.size == 150_000
