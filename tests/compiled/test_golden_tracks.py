"""The hand that was tracked before is tracked still."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compiled.golden_tracks import CASES, IN_TROUBLE, PLACE, SPECS, track_recording
from tests.rendered import Rendered

NEAREST, NEAREST_OF_OTHER_PICTURES = 1e-6, 0.2
"""Of each number's size, or of one. Another processor renders a pixel now and then otherwise,
which moves a hand in trouble by degrees."""


@pytest.mark.parametrize("case", CASES)
def test_recording_tracked_again_gives_same_numbers(case: str, rendered: Rendered) -> None:
    found = track_recording(rendered(SPECS[case.removesuffix(IN_TROUBLE)]), in_trouble=case.endswith(IN_TROUBLE))
    with np.load(PLACE) as file:
        expected = {key: file[f"{case}/{key}"] for key in found}
    nearest = NEAREST if found.pop("pictures") == expected["pictures"] else NEAREST_OF_OTHER_PICTURES
    np.testing.assert_array_equal(found["status"], expected["status"])
    for key, numbers in found.items():
        np.testing.assert_allclose(numbers, expected[key], rtol=nearest, atol=nearest, err_msg=key)
