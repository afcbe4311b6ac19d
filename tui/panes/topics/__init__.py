"""The topics pane."""
