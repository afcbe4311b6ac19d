"""How widgets become lines of the screen with less work than Textual does for it."""
