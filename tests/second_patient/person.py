"""Who is simulated: bones, thickness of the flesh, how far the skin glides, how far the palm cups.

Bone frame B of a RIGHT hand: origin in the head of the capitate, about which the wrist turns; x distal, y to the
thumb, z out of the back of the hand. Rays are counted 0 thumb, 1 index to 4 little finger.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray

# Buryanov & Kotiuk 2010 by reference 3.3: metacarpal, proximal, middle, distal phalanx with the soft tip; mm.
_THUMB_MM = (46.2, 31.6, 21.7 + 5.7)
_FINGER_MM = (
    (68.1, 39.8, 22.4, 15.8 + 3.8),
    (64.6, 44.6, 26.3, 17.4 + 4.0),
    (58.0, 41.4, 25.7, 17.3 + 4.0),
    (53.7, 32.7, 18.1, 16.0 + 3.7),
)
_CARPUS_MM = 25.0
_WHOLE_MM = _CARPUS_MM + sum(_FINGER_MM[1])

_BASE_MM = np.array([[4.0, 21.0, -10.0], [17.0, 11.0, -1.0], [19.0, 1.0, 0.0], [17.0, -8.0, -2.0], [13.0, -16.0, -5.0]])
"""CMC joints 1 to 5 of a hand of that size."""
_RAY_DEG = np.array([7.5, 0.0, -7.0, -14.0])
_RAY_DOWN_DEG = np.array([0.5, 0.0, 1.5, 4.0])
"""Directions of metacarpals 2 to 5: to the thumb, and down along the arch of the flat hand."""
_FAN_DEG = np.array([30.0, 5.0, 0.0, -5.0, -10.0])
_ROLL_DEG = 48.0
_BONE_SD = 0.05

# Depth of the joint centres below the skin (reference 2), mean and half range, mm.
_DEEP_MM = {"MCP": (11.0, 1.8), "PIP": (7.5, 1.0), "DIP": (5.6, 0.8), "TIP": (5.0, 0.6), "WRIST": (15.0, 2.5)}


@dataclass(frozen=True, slots=True)
class Person:
    """One drawn person; metres and radians.

    ``base_m`` (5, 3) CMC joints, ``knuckle_m`` (4, 3) MCP joints 2 to 5; ``thumb_m`` (3,) MC PP DP; ``finger_m`` (4, 3)
    PP MP DP up to the end of the finger; ``fan_rad`` (5,) and ``roll_rad`` as rho and tau of the reference;
    ``deep_m`` depth below the skin of the joints by kind; ``girth`` (5,) factor of each ray's flesh;
    ``cup_rad`` (2,) flexion of metacarpals 4 and 5 in a full grip; ``glide_m`` how far skin slips over bone by disc
    (knuckles and PIP for 90 degrees, MCP1 and IP1 for 60, CMC1 for 40 of palmar abduction, WRIST from 60 of flexion to
    60 of extension); ``rise_m`` of the knuckles in a fist.
    """

    size: float
    base_m: FloatArray
    knuckle_m: FloatArray
    thumb_m: FloatArray
    finger_m: FloatArray
    fan_rad: FloatArray
    roll_rad: float
    deep_m: dict[str, float]
    girth: FloatArray
    cup_rad: FloatArray
    glide_m: dict[str, float]
    rise_m: float


def draw_person(rng: np.random.Generator, *, rigid: bool = False) -> Person:
    """An adult; ``rigid``: one whose skin and palm do not move."""

    def around(mean: FloatArray | float, sd: float, shape: tuple[int, ...] = ()) -> FloatArray:
        return mean + sd * np.clip(rng.normal(size=shape), -2.0, 2.0)

    size = float(around(182.0, 10.0)) / _WHOLE_MM
    bones = size * 1e-3 * np.array(_FINGER_MM) * around(1.0, _BONE_SD, (4, 4))
    thumb = size * 1e-3 * np.array(_THUMB_MM) * around(1.0, _BONE_SD, (3,))
    base = size * 1e-3 * (_BASE_MM + around(0.0, 0.8, (5, 3)))
    ray = np.radians(around(_RAY_DEG, 1.2, (4,)))
    down = np.radians(_RAY_DOWN_DEG * around(1.0, 0.3, (4,)))
    along = np.stack((np.cos(ray) * np.cos(down), np.sin(ray) * np.cos(down), -np.sin(down)), axis=-1)
    deep = {
        kind: size * 1e-3 * (mean + half * float(rng.uniform(-1.0, 1.0))) for kind, (mean, half) in _DEEP_MM.items()
    }
    glide = {f"MCP{k}": float(rng.uniform(2e-3, 6e-3)) for k in (2, 3, 4, 5)}
    glide |= {f"PIP{k}": float(rng.uniform(0.3e-3, 1.5e-3)) for k in (2, 3, 4, 5)}
    glide |= {f"DIP{k}": float(rng.uniform(0.1e-3, 0.8e-3)) for k in (2, 3, 4, 5)}
    glide |= {"MCP1": float(rng.uniform(2e-3, 4e-3)), "IP1": float(rng.uniform(0.3e-3, 1.0e-3))}
    glide |= {"WRIST": float(rng.uniform(3e-3, 8e-3)), "CMC1": float(rng.uniform(2e-3, 5e-3))}
    cup = np.radians([rng.uniform(10.0, 12.0), rng.uniform(18.0, 20.0)])
    return Person(
        size=size,
        base_m=base,
        knuckle_m=base[1:] + bones[:, :1] * along,
        thumb_m=thumb,
        finger_m=bones[:, 1:],
        fan_rad=np.radians(around(_FAN_DEG, 1.5, (5,))),
        roll_rad=float(np.radians(around(_ROLL_DEG, 4.0))),
        deep_m=deep,
        girth=around(1.0, 0.06) * around(1.0, 0.03, (5,)),
        cup_rad=np.zeros(2) if rigid else cup,
        glide_m=dict.fromkeys(glide, 0.0) if rigid else glide,
        rise_m=0.0 if rigid else float(rng.uniform(1.0e-3, 2.5e-3)),
    )
