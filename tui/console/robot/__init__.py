"""What the console knows and asks of the robot itself."""
