"""Watchdogs for threads that compute endlessly or hang, and what the operating system reports about them."""
