"""The robot's safety in the hands of the person at the keyboard."""
