"""From a picture to blobs: skin region, marker colour, sub-pixel centres, depths (wrist paper III-A)."""
