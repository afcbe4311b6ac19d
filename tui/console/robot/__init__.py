"""The console's view of the robot, and its commands to it."""
