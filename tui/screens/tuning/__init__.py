"""A tuning under way: its screen, and the door to it."""
