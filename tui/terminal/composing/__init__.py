"""Composing widgets into screen lines with less work than Textual does."""
