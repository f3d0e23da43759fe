"""The live engine: threads with one task each, joined by bounded queues."""
