"""The method of the two papers as written, wrist and whole hand, as the reference for everything else."""
