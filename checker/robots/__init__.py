"""The robots of a package: which files describe them, with which arguments, and their parts."""
