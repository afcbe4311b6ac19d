"""Arithmetic that people type, parsed here and never run as Python: of numbers, and of curves over time."""
