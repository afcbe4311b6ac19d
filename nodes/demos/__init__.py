"""The nodes of ROS 2's tutorials, one folder per package; the importer serves this one as `bot_console_demos`."""
