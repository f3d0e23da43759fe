"""Live cameras: a driver is served in a process of its own."""
