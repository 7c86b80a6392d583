"""Who takes an upload that has come whole: looks at it, keeps it, and orders its check."""
