"""Permissions and rates of clients."""
