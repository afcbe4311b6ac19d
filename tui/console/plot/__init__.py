"""Collects time series from topics and parameters."""
