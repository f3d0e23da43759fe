"""Sessions in open formats, and what other programs wrote in them: one file for each format."""
