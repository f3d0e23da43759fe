"""Sessions in open formats, and readers of other programs' files: one module for each format."""
