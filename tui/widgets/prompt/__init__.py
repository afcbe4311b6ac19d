"""Questions to the person at the keyboard: each carries what is to happen with its answer."""
