"""Screens over the panes: help, details, questions."""
