"""What a key is, and what a person may change about keys; which there are stands in `tui/keymap.py`."""
