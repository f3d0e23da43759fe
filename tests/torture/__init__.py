"""``make torture``: kills, damaged files, wrong clocks. What must hold is a test; what is measured is printed."""
