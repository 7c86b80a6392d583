"""Strangers' archives: checked before anything is unpacked."""
