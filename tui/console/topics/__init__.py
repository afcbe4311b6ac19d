"""Measures, reads and publishes topics, calls services, and sends goals for the console."""
