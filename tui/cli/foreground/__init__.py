"""A program in the foreground of a terminal: its descriptors, its signals, the watch for hangs, hints it has given."""
