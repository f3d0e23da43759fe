"""What law and habit ask of those who keep patients' data: a log of who did what, erasure, retention, back-up."""
