"""PLG: plugins and their parameters."""
