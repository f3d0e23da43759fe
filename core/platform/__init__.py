"""The computer around the program: disks, durable writing, child processes, version."""
