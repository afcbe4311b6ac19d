"""Command lines that keep running below the panes."""
