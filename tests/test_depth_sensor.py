"""What is stated of each depth sensor, and what is taken from a file."""

from __future__ import annotations

import dataclasses
import json

import cv2
import numpy as np
import pytest

from carpus.core.model.depth_sensor import (
    ASSUMED,
    AZURE_KINECT,
    D415,
    D435,
    D455,
    PRIMESENSE,
    SENSORS,
    DepthSensor,
    parse_sensor,
)
from carpus.core.simulation.sensor import window_noise

Z_M = np.array([0.5, 0.7, 1.2])


def test_noise_models_match_their_sources() -> None:
    """Half a step of 1/8 pixel; z^2 over focal length and baseline; a millimetre at a metre."""
    assert PRIMESENSE.reading_sd_m(Z_M) == pytest.approx(1.425e-3 * Z_M**2, rel=1e-15)
    for sensor, baseline_m, focal_px in ((D415, 0.055, 1004.0), (D435, 0.05, 424.0), (D455, 0.095, 424.0)):
        assert sensor.reading_sd_m(Z_M) == pytest.approx(Z_M**2 * 0.08 / (focal_px * baseline_m))
    assert float(AZURE_KINECT.reading_sd_m(np.array(1.0))) == pytest.approx(1e-3)
    halved = D435.with_focal(212.0)
    assert halved.reading_sd_m(Z_M) == pytest.approx(2.0 * D435.reading_sd_m(Z_M))
    assert halved.stays.square_per_m == pytest.approx(2.0 * D435.stays.square_per_m)
    larger = D435.with_focal(424.0, 2.0 * 525.0)
    assert (larger.reading, larger.stays) == (D435.reading, D435.stays), "the law is in depth's own geometry"
    assert larger.patch_px == pytest.approx(2.0 * D435.patch_px)
    assert dataclasses.replace(D435, origin=ASSUMED).with_focal(212.0).origin == ASSUMED, "no source has stated it"


def test_mean_sd_averages_only_independent_readings() -> None:
    many = np.full(3, 400.0)
    assert np.array_equal(PRIMESENSE.mean_sd_m(Z_M, many), PRIMESENSE.reading_sd_m(Z_M))
    assert AZURE_KINECT.mean_sd_m(Z_M, many) == pytest.approx(AZURE_KINECT.reading_sd_m(Z_M) / 10.0)
    assert np.array_equal(AZURE_KINECT.mean_sd_m(Z_M, np.ones(3)), AZURE_KINECT.reading_sd_m(Z_M))


@pytest.mark.parametrize("sensor", SENSORS.values(), ids=SENSORS)
def test_parse_sensor_restores_every_sensor(sensor: DepthSensor) -> None:
    said = json.loads(json.dumps(sensor.to_dict()))
    assert parse_sensor(said) == sensor
    assert parse_sensor(said | {"colour_of_its_case": "grey"}) == sensor
    assert parse_sensor(sensor.name) == sensor


@pytest.mark.parametrize(
    "wrong",
    [
        {"name": ""},
        {"name": 7},
        {"kind": "radar"},
        {"kind": ["time of flight"]},
        {"reading": {"fixed_m": -1.0, "square_per_m": 0.0}},
        {"reading": {"fixed_m": 0.0, "square_per_m": 0.0}},
        {"stays": {"fixed_m": float("nan"), "square_per_m": 0.0}},
        {"stays": 3},
        {"patch_px": 0.0},
        {"averages": 1},
        {"nearest_m": 7.0},
        {"farthest_m": float("inf")},
        {"registration": None},
    ],
    ids=str,
)
def test_parse_sensor_invalid_value_raises(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="figures"):
        parse_sensor(dataclasses.asdict(D435) | wrong)


@pytest.mark.parametrize("core_px", [3, 7, 11, 21])
def test_disc_bias_is_mean_of_window_error(core_px: int) -> None:
    sensor = dataclasses.replace(D435, patch_px=11.0)
    noise = window_noise(np.random.default_rng(5), (600, 600), 11)
    found = float(np.std(cv2.blur(noise, (core_px, core_px))[40:-40, 40:-40]))
    area_px = np.array(core_px**2 / 0.4)
    stays = sensor.disc_bias_sd_m(np.array(0.7), area_px) / sensor.flat_bias_sd_m(np.array(0.7))
    assert float(stays) == pytest.approx(found, rel=0.1)
