"""Check robot simulation packages: read, judge, drive, report."""
