"""Receives the robot's diagnostics, images and frames."""
