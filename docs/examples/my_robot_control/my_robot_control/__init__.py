"""A pane for bot-console."""
