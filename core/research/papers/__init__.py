"""The method of the two papers as they are written, wrist and whole hand: what everything else is held against."""
