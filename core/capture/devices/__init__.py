"""Camera drivers, each served in a process of its own."""
