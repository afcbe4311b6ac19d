"""The package `turtle_tf2_py`: turtles as frames, and one that follows another by them."""
