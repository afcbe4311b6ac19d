"""The log records of all nodes: stored, searched and filtered."""
