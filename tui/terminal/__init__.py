"""Output to the terminal: only cells that differ from what it shows, and no faster than it can take them."""
