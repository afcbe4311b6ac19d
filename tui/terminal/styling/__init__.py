"""Styling widgets with less work than Textual does."""
