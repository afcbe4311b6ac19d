"""Which parameter changes make the robot less safe."""

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.console.parameters.safety import takes_safety

LESS, MORE = "lowers a safety margin", "raises a safety limit"
OFF = "turns a protection off"


def result(name, before, after, description=""):
    return takes_safety(ParameterInfo("/n", name, Kind.DOUBLE, before, description), before, after)


@pytest.mark.parametrize(
    ("name", "before", "after", "why"),
    [
        ("emergency_stop_distance", 0.3, 0.25, LESS),
        ("warning_distance", 0.7, 0.45, LESS),
        ("safety_distance", 0.5, 0.3, LESS),
        ("costmap.inflation_radius", 0.5, 0.3, LESS),
        ("min_obstacle_clearance", 0.5, 0.3, LESS),
        ("max_speed", 1.0, 3.5, MORE),
        ("limits.max_vel_x", 1.0, 3.5, MORE),
        ("linear.max_velocity", 1.0, 3.5, MORE),
        ("max_acceleration", 1, 2, MORE),
        ("speed_limit", 1.0, 2.0, MORE),
        ("detection_threshold", 100, 150, "makes the robot see less"),
        ("cmd_vel_timeout", 0.5, 5.0, "lets the robot drive longer without commands"),
        ("enable_safety", True, False, OFF),
        ("filter_enabled", True, False, OFF),
        ("disable_collision_check", False, True, "turns a protection off by switching it on"),
    ],
)
def test_a_change_is_less_safe_in_one_direction_only(name, before, after, why):
    assert result(name, before, after) == why
    assert result(name, after, before) == ""
    assert result(name, before, before) == ""


@pytest.mark.parametrize(
    ("name", "before", "after"),
    [
        ("odometry.distance_noise", 0.1, 0.01),
        ("update_rate", 10.0, 20.0),
        ("max_accuracy", 1, 2),
        ("robot_name", "a", "b"),
        ("include_diagnostics", True, False),
        ("safety_distance", None, 0.3),
        ("safety_distance", 0.5, "near"),
        ("enable_safety", None, False),
        ("lidar.range_max", 8.0, 12.0),
    ],
)
def test_other_parameters_are_not_safety_related(name, before, after):
    assert result(name, before, after) in ("", OFF if name == "enable_safety" else "")


def test_the_description_decides_if_the_name_does_not():
    assert result("turn_rate", 1.0, 2.0, "Maximum angular velocity (rad/s)") == MORE
    assert result("turn_rate", 1.0, 2.0) == ""
