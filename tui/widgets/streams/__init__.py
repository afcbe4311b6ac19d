"""The panels of commands that keep running below the panes."""
