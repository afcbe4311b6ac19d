"""What a key is, and how people can remap keys; the table of all keys is `tui/keymap.py`."""
