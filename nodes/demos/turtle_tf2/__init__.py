"""The package `turtle_tf2_py`: turtles as frames, and one turtle that follows another."""
