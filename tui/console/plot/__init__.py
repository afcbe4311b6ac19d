"""Time series collected from topics and parameters."""
