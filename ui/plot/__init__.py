"""Curves painted by one set of functions on the screen and on the printed page: fixed axes, bands, gaps."""
