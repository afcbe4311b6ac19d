"""The steering pane."""
