"""PKG: layout and paperwork of a package."""
