"""Report pages: their parts, and their output as PDF."""
