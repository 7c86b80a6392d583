"""The language of expressions in xacro files: a part of Python's, evaluated node by node.

Nothing is compiled or run. What is not listed here is refused.
"""
