"""The parameter pane."""
