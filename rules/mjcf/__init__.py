"""MJC: models of MuJoCo, what it refuses, and what it reads differently from what was meant."""
