"""What leaves Carpus: reports and open formats."""
