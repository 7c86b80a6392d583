"""GEO: collision and visual geometry."""
