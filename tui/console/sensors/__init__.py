"""The robot's diagnostics, cameras and frames."""
