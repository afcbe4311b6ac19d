"""The robot as the console sees it, and the commands that the console sends to it."""
