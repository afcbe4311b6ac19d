"""Stepped runs: one thread at a time, and time that jumps when all of them wait."""
