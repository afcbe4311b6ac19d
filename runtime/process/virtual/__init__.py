"""Per-node-process versions of what an interpreter has only once, by wrapping public functions."""
