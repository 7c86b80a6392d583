"""Checks as jobs: taken once, never lost, watched while they run."""
