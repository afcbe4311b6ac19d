"""A program's place among others: its domain, its workspace, its processes, and the system in the background."""
