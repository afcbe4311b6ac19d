"""The world pane."""
