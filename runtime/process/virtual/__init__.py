"""Per-node-process versions of what the interpreter has only once, by wrapping public functions."""
