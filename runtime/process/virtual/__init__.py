"""Per-node-process versions of things an interpreter has only once, made by wrapping public functions."""
