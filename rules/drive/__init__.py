"""DRV: drive plugins and motion limits."""
