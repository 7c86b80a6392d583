"""Breadcrumbs: the communication relays that a robot drops."""
