"""Untrusted archives: checked before anything is unpacked."""
