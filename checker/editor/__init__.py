"""The language server: what editors are told of a package while it is written."""
