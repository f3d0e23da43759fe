"""Texts shared by charts, reports and screens."""
