"""Support for a program in the foreground of a terminal: descriptors, signals, the hang watch, hints shown once."""
