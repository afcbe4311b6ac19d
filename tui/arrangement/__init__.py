"""Which panes are on the screen, and where."""
