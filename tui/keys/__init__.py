"""Keys, and how people can remap them; the table of all keys is `tui/keymap.py`."""
