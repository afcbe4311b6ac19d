"""A program's environment: its domain, its workspace, its processes, and the background system."""
