"""What calibrations, checks, comparisons and values by hand are called: for plots, report and screens alike."""
