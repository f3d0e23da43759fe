"""Calibration of the hand: from clicks on the first frame to its geometry and neutral pose."""
