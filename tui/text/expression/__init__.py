"""Arithmetic over numbers or curves, as people type it; it is parsed here and never run as Python."""
