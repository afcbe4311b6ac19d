"""A program's surroundings: its domain, its workspace, its processes, and the system in the background."""
