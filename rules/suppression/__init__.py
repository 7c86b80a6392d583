"""Rules on findings that are set aside: comments, settings, the baseline."""
