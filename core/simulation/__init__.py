"""Simulated patient: synthetic RGB-D recordings and measurements with their true values."""
