"""ROS 2's model of interface types, as far as `SLOT_TYPES` of message classes needs it."""
