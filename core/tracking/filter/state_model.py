"""The filter written down: x, F, Q, h and R of the palm and of a digit, with units and where each number comes from.

The palm is one chain, each of the five digits another on the palm as updated; every chain is a mixture of motion modes
(IMM) that differ in Q; the palm's differ besides in what its tissue does. A step of dt seconds makes P <- F P F' + Q;
densities q are variances per second, so that frames may come unevenly. Nothing here is computed with: a test holds the
tables to the arithmetic that they name.
"""

from __future__ import annotations

from typing import NamedTuple

from carpus.core.tracking.filter.digit_filter import ANATOMY, JOINTS, RATES
from carpus.core.tracking.filter.palm_state import POSITION, RATE, RELIEF, SHAPE, SKIN, SURFACE, TURN, VELOCITY


class StatePart(NamedTuple):
    """Some numbers of x: ``rows`` of the error vector, their ``unit`` and meaning; the parts that ``moved_by`` tells F
    puts into them, beside themselves; ``transition`` and ``noise`` as formulas; ``source`` of the constants in them."""

    name: str
    rows: slice
    unit: str
    meaning: str
    moved_by: tuple[str, ...]
    transition: str
    noise: str
    source: tuple[str, ...]


class MeasurementPart(NamedTuple):
    """Some numbers of y: how many, in which unit; what computes ``h`` and its slope, and what ``R``."""

    name: str
    size: int
    unit: str
    h: tuple[str, ...]
    r: tuple[str, ...]


PALM_STATE = (
    StatePart(
        "position", POSITION, "m", "of the fixed unit in W0, what lay under WRIST at the neutral pose",
        ("velocity",), "p + v dt", "q dt^3 / 3, with the velocity q dt^2 / 2", ("MotionNoise.acceleration_m_s2",),
    ),
    StatePart("velocity", VELOCITY, "m/s", "in W0", (), "v", "q dt", ("MotionNoise.acceleration_m_s2",)),
    StatePart(
        "turn", TURN, "rad", "error d of the rotation, R_true = R Exp(d), in W2",
        ("rate",), "Exp(w dt)' d + Jr(w dt) w dt", "q dt^3 / 3 Jr Jr', with the rate q dt^2 / 2 Jr",
        ("MotionNoise.turn_acceleration_rad_s2", "palm.compute_palm_transition"),
    ),
    StatePart(
        "rate", RATE, "rad/s", "angular velocity in W2", (), "w",
        "q dt; of turns that nothing showed by another factor",
        ("MotionNoise.turn_acceleration_rad_s2", "PalmMotion.unseen_scale"),
    ),
    StatePart(
        "shape", SHAPE, "m", "x, y, z of each of six discs from its calibrated place on the fixed unit",
        (), "s", "none; a Schmidt partial update takes a share of what a frame says",
        ("predicted_measurement.SHAPE_LEARNING_SHARE",),
    ),
    StatePart(
        "back", SURFACE, "rad, rad, m",
        "turn about X and Y and height that the calibrated back of the hand is wrong by",
        (), "s", "none; as of the shape",
        ("surface_fit.surface_calibration_covariance", "predicted_measurement.SHAPE_LEARNING_SHARE"),
    ),
    StatePart(
        "skin", SKIN, "m", "x, y, z by which each disc has left that place for now",
        (), "s exp(-dt / tau), tau by mode; s exp(-dt / tau - path / lambda) by the path of joints that are seen",
        "what keeps the mode's stationary covariance",
        ("SoftTissue.lasts_s", "SoftTissue.rests_s", "SoftTissue.lasts_rad", "soft_tissue.resting_and_moving_modes",
         "soft_tissue.joint_driven_modes"),
    ),
    StatePart(
        "relief", RELIEF, "rad, rad, m", "turn about X and Y and height by which the back has left its shape for now",
        (), "s exp(-dt / tau), tau by mode", "what keeps the mode's stationary covariance",
        ("SoftTissue.relief_still_s", "SoftTissue.relief_home_s", "soft_tissue.resting_and_moving_modes",
         "soft_tissue.joint_driven_modes"),
    ),
)  # fmt: skip

PALM_MEASUREMENTS = (
    MeasurementPart(
        "discs", 18, "px, px, m: u, v and depth z of each disc that is associated",
        ("palm.predict_palm_measurement",),
        ("palm_association.measurements_from_blobs", "predicted_measurement.adapt_noise_factor"),
    ),
    MeasurementPart(
        "surface", 3, "rad, rad, m: turn about X and Y and height of the back of the hand",
        ("surface_fit.fit_surface",), ("SurfaceSettings",),
    ),
)  # fmt: skip

DIGIT_STATE = (
    StatePart(
        "joints", JOINTS, "rad", "the thumb's five angles; a finger's abduction, MCP, PIP and what DIP is off by",
        ("rates",), "a + r dt; what is bound returns to zero as exp(-dt / tau)", "q dt^3 / 3",
        ("MotionNoise.joint_acceleration_rad_s2", "finger_model.RETURN_TIME_S"),
    ),
    StatePart(
        "rates", RATES, "rad/s", "of the joints", (), "r; fading where nothing shows the joint", "q dt",
        ("MotionNoise.joint_acceleration_rad_s2", "motion.RATE_MEMORY_S"),
    ),
    StatePart(
        "anatomy", ANATOMY, "m; fan and roll in rad",
        "three lengths, fan, roll, the root from its disc (x, y, depth), the heights of three discs",
        (), "c", "a share a second of what was not known at the start", ("finger_model.DRIFT_PER_S", "digit_start"),
    ),
)  # fmt: skip

DIGIT_MEASUREMENTS = (
    MeasurementPart(
        "discs", 9, "px, px, m: u, v and depth z of three discs",
        ("digit_images.linearise_images",),
        ("digit_association.update_digits", "digit_images.propagate_palm_error"),
    ),
    MeasurementPart(
        "knuckle", 1, "rad: flexion at a knuckle whose discs are hidden, by depth",
        ("knuckle_flexion.estimate_knuckle_flexion",),
        ("knuckle_flexion.MIN_SD_RAD", "knuckle_flexion.CORRELATED_FRAMES"),
    ),
)  # fmt: skip
