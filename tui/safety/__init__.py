"""The robot's safety, as far as the person at the keyboard affects it."""
