"""Devices of which datasheets are known."""
