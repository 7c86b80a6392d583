"""Launch files in Python: a part of the language, evaluated node by node; nothing is run."""
