"""Programs of the packages `tf2_ros` and `tf2_tools`."""
