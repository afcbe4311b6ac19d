"""The images pane."""
