"""PKG: files, names and metadata of a package."""
