"""Questions to the person at the keyboard: each carries what to do with its answer."""
