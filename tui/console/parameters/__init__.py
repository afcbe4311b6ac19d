"""Parameters of all nodes: their values, how they are set, saved and restored."""
