"""Names in the files of a package: where they are defined, mentioned, and how they change."""
