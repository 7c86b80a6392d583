"""KIN: links, joints and frames."""
