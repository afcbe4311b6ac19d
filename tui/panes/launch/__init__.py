"""The launch pane."""
