"""Watchdogs for threads that compute without end or hang, and what the operating system tells about them."""
