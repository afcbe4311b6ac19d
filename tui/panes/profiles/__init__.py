"""The profiles pane."""
