"""An app in the foreground of a terminal: its descriptors, its signals, and the watch for hangs."""
