"""The sandbox of processes that read strangers' files."""
