"""Units of the fields of common messages, from REP 103 and the comments in the message definitions."""

from __future__ import annotations

from collections.abc import Mapping

SPEED, TURN = "m/s", "rad/s"

OF_FIELD: Mapping[tuple[str, str], str] = {
    ("geometry_msgs/Twist", "linear"): SPEED,
    ("geometry_msgs/Twist", "angular"): TURN,
    ("geometry_msgs/Accel", "linear"): "m/s²",
    ("geometry_msgs/Accel", "angular"): "rad/s²",
    ("geometry_msgs/Wrench", "force"): "N",
    ("geometry_msgs/Wrench", "torque"): "N m",
    ("geometry_msgs/Transform", "translation"): "m",
    ("geometry_msgs/Pose", "position"): "m",
    ("geometry_msgs/Pose2D", "x"): "m",
    ("geometry_msgs/Pose2D", "y"): "m",
    ("geometry_msgs/Pose2D", "theta"): "rad",
    ("geometry_msgs/PointStamped", "point"): "m",
    ("geometry_msgs/Polygon", "points"): "m",
    ("geometry_msgs/Inertia", "m"): "kg",
    ("nav_msgs/MapMetaData", "resolution"): "m/cell",
    ("nav_msgs/MapMetaData", "width"): "cells",
    ("nav_msgs/MapMetaData", "height"): "cells",
    ("sensor_msgs/LaserScan", "angle_min"): "rad",
    ("sensor_msgs/LaserScan", "angle_max"): "rad",
    ("sensor_msgs/LaserScan", "angle_increment"): "rad",
    ("sensor_msgs/LaserScan", "time_increment"): "s",
    ("sensor_msgs/LaserScan", "scan_time"): "s",
    ("sensor_msgs/LaserScan", "range_min"): "m",
    ("sensor_msgs/LaserScan", "range_max"): "m",
    ("sensor_msgs/LaserScan", "ranges"): "m",
    ("sensor_msgs/Range", "field_of_view"): "rad",
    ("sensor_msgs/Range", "min_range"): "m",
    ("sensor_msgs/Range", "max_range"): "m",
    ("sensor_msgs/Range", "range"): "m",
    ("sensor_msgs/Imu", "angular_velocity"): TURN,
    ("sensor_msgs/Imu", "linear_acceleration"): "m/s²",
    ("sensor_msgs/BatteryState", "voltage"): "V",
    ("sensor_msgs/BatteryState", "temperature"): "°C",
    ("sensor_msgs/BatteryState", "current"): "A",
    ("sensor_msgs/BatteryState", "charge"): "Ah",
    ("sensor_msgs/BatteryState", "capacity"): "Ah",
    ("sensor_msgs/BatteryState", "design_capacity"): "Ah",
    ("sensor_msgs/BatteryState", "cell_voltage"): "V",
    ("sensor_msgs/BatteryState", "cell_temperature"): "°C",
    ("sensor_msgs/NavSatFix", "latitude"): "°",
    ("sensor_msgs/NavSatFix", "longitude"): "°",
    ("sensor_msgs/NavSatFix", "altitude"): "m",
    ("sensor_msgs/Temperature", "temperature"): "°C",
    ("sensor_msgs/FluidPressure", "fluid_pressure"): "Pa",
    ("sensor_msgs/Illuminance", "illuminance"): "lx",
    ("sensor_msgs/MagneticField", "magnetic_field"): "T",
    ("sensor_msgs/Image", "width"): "pixels",
    ("sensor_msgs/Image", "height"): "pixels",
    ("sensor_msgs/Image", "step"): "bytes",
}
INHERITED = ("geometry_msgs/Vector3", "geometry_msgs/Point", "geometry_msgs/Point32")
"""Types whose fields have the unit of the field that contains them."""


def field_unit(type_name: str, field: str, outer: str) -> str:
    """The unit of a field of a type (`package/Name`); `outer` is the unit of the field that contains the message."""
    return outer if type_name in INHERITED else OF_FIELD.get((type_name, field), "")
