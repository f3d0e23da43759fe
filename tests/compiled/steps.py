"""One call of every compiled function on drawn numbers, and what it returned: ``python -m tests.compiled.steps`` writes
the results anew.

They are those of an independent implementation in NumPy, to 1e-9, as long as that was kept (November 2026).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from carpus.core.compiled import association, blobs, digit_images, digits, mixture, palm, samples, surface
from carpus.core.detection.blobs import Components, Stencil, find_components, get_stencil
from carpus.core.detection.detector import ColorTable
from carpus.core.model import so3
from carpus.core.model.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.association.association import (
    LOG_IMPOSSIBLE,
    log_densities,
)
from carpus.core.tracking.digits.digit_association import DigitAssignment, DigitScene, measurements_from_assignment
from carpus.core.tracking.filter.digit_filter import (
    _DIRECTION,
    LIMIT_GATE_SD,
    LIMIT_SD_RAD,
    OBSERVED,
    digit_sigma_weights,
    draw_sigma_points,
    linearise_digits,
    slot_limits_rad,
)
from carpus.core.tracking.filter.hand_geometry import palm_calibration
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    Transition,
    UnscentedParameters,
    compute_weights,
    mode_transition_matrix,
    partial_update_shares,
    update_mixture,
)
from carpus.core.tracking.filter.motion import MotionNoise, PalmMotion
from carpus.core.tracking.filter.palm_state import RELIEF, SIZE, SURFACE, PalmView
from carpus.core.tracking.filter.predicted_measurement import Measurements
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import AssociationSettings, TrackerSettings
from carpus.core.tracking.filter.soft_tissue import (
    DigitSpeeds,
    SoftTissue,
    joint_driven_modes,
    resting_and_moving_modes,
    single_moving_mode,
)
from carpus.core.tracking.filter.surface_fit import SurfaceSettings
from carpus.core.tracking.finger_filter import FingerFilter
from carpus.core.tracking.hand_filter import HandFilter
from tests.accuracy.carpus import calibrate_sequence
from tests.simulation.measurements import measurement_sequence
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M
from tests.tracking.test_palm_filter import moving
from tests.tracking.test_surface_fit import build_surface, get_surface_point

PLACE = Path(__file__).with_name("golden_steps.npz")
UNIT_M = 2e-4
Step = tuple[Callable[..., Any], tuple[Any, ...]]
Steps = dict[str, Step]


def find_arrays(value: Any) -> list[np.ndarray]:
    """Every array and number of a result, in order."""
    if is_dataclass(value):
        return [one for field in fields(value) for one in find_arrays(getattr(value, field.name))]
    if isinstance(value, tuple | list):
        return [one for part in value for one in find_arrays(part)]
    return [np.asarray(np.nan if value is None else value)]


def project(value: Any) -> FloatArray:
    """Of each array of a result: type, shape, largest number, means by drawn weights, of numbers and of unknowns."""
    out = []
    for array in find_arrays(value):
        numbers = np.nan_to_num(array.astype(np.float64), posinf=7.0, neginf=-7.0).ravel()
        weights = np.random.default_rng(numbers.size).uniform(0.5, 1.5, (3, numbers.size)) / max(numbers.size, 1)
        shape = float(np.dot((1, *array.shape), 10.0 ** np.arange(array.ndim + 1)))
        means = [*(weights @ numbers), weights[0] @ ~np.isfinite(array.astype(np.float64)).ravel()]
        out.append([float(array.dtype.num), shape, np.abs(numbers).max(initial=0.0), *means])
    return np.array(out)


def draw_covariances(rng: np.random.Generator, *shape: int) -> FloatArray:
    """Positive definite matrices (..., n, n) of ``shape`` (..., n)."""
    root = rng.normal(size=(*shape, shape[-1]))
    return np.asarray(root @ np.swapaxes(root, -1, -2) / shape[-1] + np.eye(shape[-1]))


def draw_mixture(rng: np.random.Generator, chains: int, modes: int, n: int) -> ModeMixture:
    probability = rng.uniform(0.1, 1.0, size=(chains, modes))
    return ModeMixture(
        rng.normal(size=(chains, modes, n)),
        draw_covariances(rng, chains, modes, n),
        probability / probability.sum(axis=1, keepdims=True),
    )


def draw_linearisation(rng: np.random.Generator, chains: int, n: int, m: int) -> Linearisation:
    """A measurement of few numbers each."""
    slope = rng.normal(size=(chains, m, n)) * (rng.uniform(size=(chains, m, n)) < 0.4)
    return Linearisation(
        rng.normal(size=(chains, m)), slope, draw_covariances(rng, chains, m), rng.normal(size=(chains, n))
    )


def draw_mixture_steps() -> Steps:
    """The palm's and the digits' mixtures, one mode, and small odd ones."""
    out: Steps = {}
    for size in ((1, 8, 54, 18), (5, 2, 21, 9), (1, 1, 54, 3), (2, 3, 5, 2)):
        rng, (chains, modes, n, m) = np.random.default_rng(7), size
        some, switch = draw_mixture(rng, chains, modes, n), mode_transition_matrix(modes, 0.5, 0.03)
        forward, noise = rng.normal(size=(chains, n, n)), draw_covariances(rng, chains, modes, n)
        forward[rng.uniform(size=forward.shape) < 0.6] = 0.0
        third = n // 3  # mixes; the last third relaxes
        kept = np.where(np.arange(n) < third, 1.0, rng.uniform(0.2, 1.0, size=(modes, n)))
        step = Transition(
            rng.normal(size=(third, third)), draw_covariances(rng, modes, third), kept,
            draw_covariances(rng, modes, third),
        )  # fmt: skip
        out |= {
            f"merge {size}": (mixture.merge_modes, (some,)),
            f"predict {size}": (mixture.predict_modes, (some, forward, noise, switch)),
            f"propagate {size}": (mixture.predict_palm_modes, (some, step, rng.normal(size=n), switch)),
        }
        line = draw_linearisation(rng, chains, n, m)
        for unseen in (0.0, 0.5, 1.0):
            measured = np.where(rng.uniform(size=(chains, m)) < unseen, np.nan, rng.normal(size=(chains, m)))
            variance = np.where(np.isnan(measured), np.nan, rng.uniform(1e-6, 2.0, size=(chains, m)))
            shared, partial = draw_covariances(rng, chains, m), partial_update_shares(n, slice(1, 3), 0.3)
            blind, full = (some, line, measured, variance), (some, line, measured, variance, shared, partial)
            out |= {
                f"update {size} {unseen}": (update_mixture, blind),
                f"update {size} {unseen}, tested {m - 1}": (update_mixture, (*full, m - 1)),
            }
    far = draw_mixture(np.random.default_rng(11), 1, 3, 6)
    far.mean[0, 2] += 1e3
    of = far, draw_linearisation(np.random.default_rng(12), 1, 6, 4), np.ones((1, 4)), np.ones((1, 4))
    return out | {"update far off": (update_mixture, of)}


def draw_association_steps() -> Steps:
    """Six markers and blobs near them, some without a depth, some with another's."""
    settings, out = AssociationSettings(), {}
    rest = log_densities(3e5, settings), settings.gate_sd**2, LOG_IMPOSSIBLE
    for count in (0, 1, 25):
        rng, scale = np.random.default_rng(4), np.array([1.0, 1.0, 0.003])
        covariance = draw_covariances(rng, 6, 3) * scale[:, None] * scale
        expected = rng.normal(size=(6, 3)) * [20.0, 20.0, 0.01] + [320.0, 240.0, 0.7]
        measured = expected[rng.integers(0, 6, count)] + rng.normal(size=(count, 3)) * 3.0 * scale
        measured[1::4, 2] = np.nan
        measured[2::4, 2] += 0.2
        variance = np.broadcast_to([0.04, 0.04, 1e-6], (count, 3)).copy()
        out[f"odds of {count}"] = (association.compute_log_odds, (expected, covariance, measured, variance, *rest))
    return out


def draw_sample_steps() -> Steps:
    """Readings inside an outline and round discs: in the picture, across its edges and off it."""
    rng = np.random.default_rng(7)
    raw = (rng.integers(3500, 3550, (240, 320)) * (rng.uniform(size=(240, 320)) < 0.8)).astype(np.uint16)
    corners = np.array([[160.3, 190.2], [128.6, 172.8], [124.1, 100.7], [146.8, 92.4]])
    around = rng.uniform((120.0, 80.0), (220.0, 190.0), (15, 2))
    out: Steps = {}
    for shift in (0.0, -135.5, 140.0, -90.25, 1e4, -1e12):
        for most in (1, 40, 5000):
            where = f"{shift} {most}"
            out[f"outline {where}"] = (samples.sample_outline, (raw, UNIT_M, corners + shift, 1.2, 4.0, 3, most))
            out[f"discs {where}"] = (samples.sample_discs, (raw, UNIT_M, around + shift, 12.0, 4, most))
    for count in (1, 2, 3, 9):
        places, step = rng.uniform(-60.0, 360.0, (count, 2)), int(rng.integers(1, 40))
        out[f"outline of {count}"] = (samples.sample_outline, (raw, UNIT_M, places, 1.2, 4.0, step, 112))
        out[f"discs of {count}"] = (samples.sample_discs, (raw, UNIT_M, places, 12.0, step, 352))
    out["discs in one place"] = (samples.sample_discs, (raw, UNIT_M, np.full((4, 2), 160.0), 12.0, 4, 10))
    out["discs without depth"] = (samples.sample_discs, (np.zeros_like(raw), UNIT_M, around, 12.0, 4, 10))
    return out


def draw_palm_steps() -> Steps:
    """Motions of every model of the soft tissue, and the palm seen and reset."""
    out: Steps = {}
    for tissue in (single_moving_mode, resting_and_moving_modes, joint_driven_modes):
        for scales, dt_s in (((1.0,), 0.033), ((0.5, 4.0), 0.0), ((0.5, 4.0), 3.0)):
            motion = PalmMotion(MotionNoise(), tissue(SoftTissue()), np.array(scales))
            for hidden in (None, np.diag([1.0, 0.0, 0.0])):
                rate = moving(1).rate_rad_s if hidden is None else np.zeros(3)
                name = f"{tissue.__name__} {scales} {dt_s} {hidden is None}"
                out[name] = (palm.compute_palm_transition, (motion, rate, dt_s, hidden, DigitSpeeds(0.7, 1.3)))
    for modes in (1, 3, 8):
        rng, estimate = np.random.default_rng(modes), moving(modes)
        turned = FROM_ABOVE @ so3.exp(0.2 * rng.normal(size=3))
        view = PalmView(CAMERA, turned, MIDDLE_M, RIGHT_PALM_M, 0.3 * rng.normal(size=(6, 18)))
        probability = rng.uniform(0.1, 1.0, size=(1, modes))
        some = ModeMixture(
            0.01 * rng.normal(size=(1, modes, SIZE)),
            estimate.covariance * rng.uniform(0.5, 2.0, size=(1, modes, 1, 1)),
            probability / probability.sum(),
        )
        weights = compute_weights(6, UnscentedParameters())
        out[f"palm seen {modes}"] = (palm.predict_palm_measurement, (estimate, some, view, weights))
        out[f"palm reset {modes}"] = (palm.reset_errors, (estimate, some))
    return out


def draw_surface_steps() -> Steps:
    """A palm a little off, and readings of its back, an odd and an even number and too few."""
    back, out = build_surface(), {}
    for sensor in (PRIMESENSE, D435, AZURE_KINECT):
        for every in (7, 8, 900):
            rng, estimate = np.random.default_rng(every), moving(every)
            rotation, position = so3.exp(rng.normal(0.0, 0.1, 3)), rng.normal(0.0, 0.005, 3)
            estimate.value[RELIEF], estimate.value[SURFACE] = 0.01 * rng.normal(size=(2, 3))
            estimate.value[:3] = position
            read = get_surface_point(rotation, position)
            some = SurfaceSamples(read.pixel[::every].copy(), read.depth_m[::every] + 1e-3 * rng.normal(size=1))
            off = replace(estimate, rotation_w2_w0=rotation @ so3.exp(0.01 * rng.normal(size=3)))
            view = PalmView(replace(CAMERA, sensor=sensor), FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, np.zeros((6, 18)))
            out[f"surface {sensor.name} {every}"] = (
                surface.measure_surface,
                (off, some, back, view, SurfaceSettings()),
            )
    return out


@dataclass(frozen=True)
class _Seen:
    """A picture with discs: at the border, beside each other, at an edge of the hand; with noise and holes in depth."""

    blobs: Components
    stencil: Stencil
    hsv: np.ndarray
    color: np.ndarray
    raw: np.ndarray
    table: ColorTable
    sensor: DepthSensor


def radius_at(place: np.ndarray) -> np.ndarray:
    """Larger to the right."""
    return np.asarray(4.5 * (0.7 + 0.003 * place[:, 0]))


def measure_blobs(seen: _Seen) -> tuple[Any, ...]:
    """All that is measured of blobs."""
    windows = blobs.BlobWindows(seen.blobs, seen.stencil)
    return (
        *windows.compare_colors(seen.hsv, seen.table),
        *windows.locate_centres(seen.color),
        *windows.read_depths(seen.raw, UNIT_M, seen.sensor),
    )


def draw_mask(shapes: str, density: float, size: tuple[int, int] = (150, 200)) -> np.ndarray:
    """Spirals of specks that join late, discs on and beside each other, or bars mirrored to the pixel."""
    rng, mask = np.random.default_rng(8), np.zeros(size, dtype=np.uint8)
    if shapes == "specks":
        return np.asarray(rng.uniform(size=mask.shape) < density).astype(np.uint8)
    for _ in range(int(100 * density)):
        u, v, radius = (int(rng.integers(*ends)) for ends in ((0, 200), (0, 150), (3, 7)))
        for _ in range(rng.integers(1, 5)):
            if shapes == "discs":
                cv2.circle(mask, (u, v), radius, 1, -1)
            else:
                cv2.rectangle(mask, (u, v), (u + 2 * radius, v + radius), 1, -1)
            u, v = u + int(rng.integers(-8, 9)), v + int(rng.integers(-8, 9))
    return mask


def draw_blob_steps() -> Steps:
    """Blobs of all shapes found, and measured before sensors of all kinds, with stencils of all sizes."""
    out: Steps = {}
    masks = {f"{shape} {density}": draw_mask(shape, density) for shape in ("specks", "discs", "bars")
             for density in (0.1, 0.35, 0.5)}  # fmt: skip
    small = {f"{size}": draw_mask("specks", 0.5, size) for size in ((1, 1), (1, 40), (40, 1), (2, 3), (17, 5))}
    for name, mask in (masks | small | {"nothing": np.zeros((20, 30), dtype=np.uint8)}).items():
        for least, most in ((0.0, np.inf), (0.9, 1.4)):
            out[f"blobs {name} {least}"] = (blobs.find_blobs, (mask, radius_at, least, most))
    rng, (v, u) = np.random.default_rng(5), np.mgrid[:120, :160]
    hsv, is_paper = rng.integers(0, 256, (40, 50, 3)).astype(np.uint8), (255 * rng.integers(0, 2, 1 << 16))
    for darkest in (0.0, 99.5, 255.0, np.nan):
        out[f"paper {darkest}"] = (blobs.mask_paper, (hsv, is_paper.astype(np.uint8), darkest))
    place = np.array([[30.2, 40.7], [80.0, 60.4], [89.0, 62.0], [2.0, 100.0], [157.0, 3.0], [120.3, 90.8], [60, 20]])
    away = np.hypot(u[..., None] - place[:, 0], v[..., None] - place[:, 1]).min(axis=-1)
    share = np.clip(5.0 - away, 0.0, 1.0)[..., None]
    ground = np.where((u < 100)[..., None], (205, 155, 130), (95, 92, 88))
    noise = rng.normal(0.0, 4.0, (120, 160, 3))
    color = np.clip(ground + share * (np.array((35, 80, 165)) - ground) + noise, 0, 255).astype(np.uint8)
    raw = 3500 + np.rint(8.0 * rng.normal(size=u.shape)) + 250.0 * (u > 125) + 12.0 * (u - 60) * (v < 35)
    raw[(rng.uniform(size=u.shape) < 0.2) | ((u > 84) & (u < 95))] = 0
    table = ColorTable(
        rng.integers(0, 256, 1 << 16).astype(np.uint8), rng.uniform(size=1 << 16) < 0.5,
        np.sqrt(rng.dirichlet(np.ones(256))),
    )  # fmt: skip
    found = find_components((share[..., 0] > 0.5).astype(np.uint8), radius_at)
    colors = np.asarray(cv2.cvtColor(color, cv2.COLOR_RGB2HSV))
    seen = _Seen(found, get_stencil(4.5), colors, color, raw.astype(np.uint16), table, PRIMESENSE)
    for sensor in (PRIMESENSE, D435, AZURE_KINECT):
        out[f"measured by {sensor.name}"] = (measure_blobs, (replace(seen, sensor=sensor),))
    for radius_px in (1.0, 9.3, 40.0):  # the largest is wider than the picture
        out[f"measured within {radius_px}"] = (measure_blobs, (replace(seen, stencil=get_stencil(radius_px, 2)),))
    out["none measured"] = (measure_blobs, (replace(seen, blobs=found.subset(np.empty(0, dtype=np.int64))),))
    for shapes in ("specks", "bars"):  # windows without a core or a rim, cores with a single reading
        any_color = rng.integers(0, 256, (2, 150, 200, 3)).astype(np.uint8)
        any_raw = (rng.integers(3500, 3530, (150, 200)) * rng.integers(0, 2, (150, 200))).astype(np.uint16)
        some = find_components(masks[f"{shapes} 0.35"], radius_at)
        of = replace(seen, blobs=some, hsv=any_color[0], color=any_color[1], raw=any_raw)
        out[f"measured {shapes}"] = (measure_blobs, (of,))
    return out


def draw_digit_steps() -> Steps:
    """Calibrated hands of both sides whose palm sits somewhere, their digits bent at random or anywhere."""
    out: Steps = {}
    scaling, settings = UnscentedParameters(), TrackerSettings()
    for side, seed, is_lost in (("right", 0, False), ("left", 1, False), ("right", 1, True)):
        rng, name = np.random.default_rng(seed), f"{side} {seed} {is_lost}"
        recorded = RecordingSpec(seed=61, protocol="hand21", motion="fist", seconds=1.5, hand=side)
        known = calibrate_sequence(measurement_sequence(recorded))
        fingers, view = FingerFilter(known, CAMERA, settings), HandFilter(known, CAMERA, settings).view
        estimate = replace(moving(seed), covariance=1e-2 * moving(seed).covariance)
        base = Readout(palm_calibration(known), view.camera, 6e-3).compute_base(estimate, view)
        mean, covariance = fingers.model.neutral_mixture().merge()
        if is_lost:
            mean, covariance = fingers.model.diffuse_mixture(mean, covariance).merge()
        else:
            scale = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
            mean = mean + scale * rng.normal(size=mean.shape)
            mean[:, :5] += rng.uniform(0.0, 1.2, size=(5, 5))
            covariance = draw_covariances(rng, 5, 21) * scale[:, :, None] * scale[:, None]
        root_m, pose = base.palm.disc_m[1:], mean[:, OBSERVED]
        points, weights = draw_sigma_points(mean, covariance, root_m, scaling), digit_sigma_weights(scaling)
        images = linearise_digits(points, base.view, scaling)
        many = np.repeat(pose[[0, 2], None], 4, axis=1) + np.linspace(0.0, 0.3, 4)[:, None]
        out |= {
            f"digits {name}": (digits.place_digits, (pose, root_m)),
            f"discs {name}": (digits.place_discs, (many, root_m[[0, 2]], [0, 2])),
            f"points {name}": (digits.compute_digit_sigma_points, (mean, covariance, root_m, weights.scale)),
            f"images {name}": (digit_images.linearise_images, (points, base.view, weights)),
            f"inherited {name}": (digit_images.compute_inherited, (covariance, base, images, points.normal)),
        }
        for wide, bent_rad in ((1e-6, 0.7), (1.0, 0.0), (1.0, -1.2), (30.0, 2.5), (1.0, 40.0)):
            both = np.repeat(mean[:, None], 2, axis=1) + 0.01 * rng.normal(size=(5, 2, 21))
            both[:, :, :5] += bent_rad
            some = ModeMixture(both, np.repeat(wide * covariance[:, None], 2, axis=1), np.ones((5, 2)))
            of = some, slot_limits_rad(some.mean[:, 0, :5]), _DIRECTION, LIMIT_SD_RAD, LIMIT_GATE_SD
            out[f"limits {name} {wide} {bent_rad}"] = (digits.apply_limits, of)
        for blobs_seen in (0, 9):
            value = rng.normal(size=(blobs_seen, 3)) + [300.0, 200.0, 0.7]
            value[1::3, 2] = np.nan
            named = np.where(rng.uniform(size=(5, 3)) < 0.6, rng.integers(0, max(blobs_seen, 1), (5, 3)), -1)
            named = named.astype(np.int64) if blobs_seen else np.full((5, 3), -1)
            names = DigitAssignment(named, (named >= 0) & (rng.uniform(size=(5, 3)) < 0.7))
            whole_px = np.where(rng.uniform(size=(5, 3)) < 0.2, np.nan, 60.0)
            crowded = replace(images, value=np.where(np.arange(9) % 3 == 2, 0.7, images.value * 0.05))
            for how, seen in (("", images), ("crowded", crowded)):
                scene = DigitScene(
                    covariance, seen, seen.image_covariance, seen.image_covariance, rng.uniform(0.3, 0.98, (5, 3)),
                    Measurements(value, rng.uniform(0.01, 0.1, (blobs_seen, 3))), np.ones(blobs_seen, dtype=bool),
                    rng.uniform(10.0, 90.0, blobs_seen), whole_px, whole_px * 1e-6, rng.uniform(0.6, 3.0, (5, 9)), 3e5,
                    base.view, 0.2, np.arange(5) < 4,
                )  # fmt: skip
                out[f"named {name} {blobs_seen} {how}"] = (measurements_from_assignment, (scene, names, settings))
    return out


def find_array_paths(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], np.ndarray]]:
    """Where arrays are in nested dataclasses and tuples."""
    if is_dataclass(value):
        for field in (one for one in fields(value) if one.init):
            yield from find_array_paths(getattr(value, field.name), (*path, field.name))
    elif isinstance(value, tuple):
        for index, one in enumerate(value):
            yield from find_array_paths(one, (*path, index))
    elif isinstance(value, np.ndarray):
        yield path, value


def replace_at(value: Any, path: tuple[Any, ...], new: np.ndarray) -> Any:
    """The value with another array at a path."""
    if not path:
        return new
    first, *rest = path
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{str(first): replace_at(getattr(value, str(first)), tuple(rest), new)})
    return tuple(replace_at(one, tuple(rest), new) if k == first else one for k, one in enumerate(value))


def draw_damaged_steps(steps: Steps) -> Steps:
    """The first call of each function with one number unknown, and with one array negative, for each array of it."""
    out: Steps = {}
    first = {function: (function, given) for function, given in reversed(steps.values())}
    for function, given in first.values():
        for path, array in find_array_paths(given):
            if array.dtype == np.float64 and array.size:
                unknown = array.copy()
                unknown.flat[array.size // 2] = np.nan
                name = f"{function.__name__} {path}"
                out[f"{name} unknown"] = (function, replace_at(given, path, unknown))
                out[f"{name} negative"] = (function, replace_at(given, path, -array))
    return out


def run_step(step: Step) -> Any:
    """What a call returns; nothing where a covariance is none."""
    function, given = step
    try:
        with np.errstate(invalid="ignore"):
            return function(*given)
    except (np.linalg.LinAlgError, ValueError) as error:
        return float(isinstance(error, np.linalg.LinAlgError))


@cache
def draw_steps() -> Steps:
    """Every call by its name."""
    steps = {
        **draw_mixture_steps(), **draw_association_steps(), **draw_sample_steps(), **draw_palm_steps(),
        **draw_surface_steps(), **draw_blob_steps(), **draw_digit_steps(),
    }  # fmt: skip
    return steps | draw_damaged_steps(steps)


if __name__ == "__main__":
    np.savez_compressed(PLACE, **{name: project(run_step(step)) for name, step in draw_steps().items()})
