"""Evaluates the subset of Ruby that spawners use, node by node, without any side effect."""
