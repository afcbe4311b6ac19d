"""How widgets are styled with less work than Textual does for it."""
