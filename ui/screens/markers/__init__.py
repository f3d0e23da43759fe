"""Calibration on one fixed picture: click the markers in order, read the verdict, start."""
