"""Arithmetic that people type, over numbers or over curves; it is parsed here and never run as Python."""
