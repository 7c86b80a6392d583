"""The specification sheet: statements of a package about its robot, each with its place.

A claim is read only where the wording leaves no doubt: a missing claim is not checked, a wrong one
would cause a false alarm.
"""
