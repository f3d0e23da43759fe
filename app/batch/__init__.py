"""Many recordings in one go: found, tracked side by side, their faults and measures gathered in tables."""
