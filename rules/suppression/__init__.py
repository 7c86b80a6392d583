"""CFG: suppressions in comments and settings, and the baseline."""
