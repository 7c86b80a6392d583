"""What is measured of a trial."""
