"""Nodes of the tutorials of ROS 2, a folder for each package; the importer serves this one as `bot_console_demos`."""
