"""A program in the foreground of a terminal: descriptors, signals, the hang watch, and hints shown once."""
