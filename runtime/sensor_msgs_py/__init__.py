"""Helpers for sensor messages, as upstream's `sensor_msgs_py`: clouds of points as NumPy arrays."""
