"""Arithmetic that people type, over numbers or over curves; parsed here, and never run as Python."""
