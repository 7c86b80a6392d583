"""Faults to plant in good robots, each with the rules that must find it."""
