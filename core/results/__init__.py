"""What reports, progress and tables say, as figures."""
