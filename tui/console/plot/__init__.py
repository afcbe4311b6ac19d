"""Series collected from topics and parameters."""
