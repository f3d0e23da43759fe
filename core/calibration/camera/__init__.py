"""Calibration of a camera on a printed board: intrinsics and depth."""
