"""The live engine: threads with one job each, joined by bounded channels with named policies."""
