"""ROS 2's model of interface types, to the extent that `SLOT_TYPES` of message classes needs it."""
