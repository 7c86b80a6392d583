"""The specification sheet: what a package states about its robot, every claim with its place.

A claim is read only where the wording leaves no doubt: a missing claim is not checked, a wrong one
would accuse an innocent model.
"""
