"""Parameter files: read as ROS reads them, patched in place, and saved."""
