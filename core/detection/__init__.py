"""Blobs of a frame: skin region, marker colour, sub-pixel centres, depths (wrist paper III-A)."""
