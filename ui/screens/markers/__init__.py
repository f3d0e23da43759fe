"""Calibration on a frozen frame: label the markers, read the verdict, start."""
