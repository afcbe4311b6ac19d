"""A solution of the page's practice exercise."""

import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node


class ExerciseRobot(Node):
    def __init__(self):
        super().__init__("exercise_robot")
        speeds = FloatingPointRange(from_value=0.1, to_value=5.0)
        limited = ParameterDescriptor(description="Maximum speed (m/s)", floating_point_range=[speeds])
        self.declare_parameter("robot_name", "Exercise", ParameterDescriptor(description="Name of the robot"))
        self.declare_parameter("max_speed", 1.0, limited)
        self.declare_parameter("turn_rate", 0.5, ParameterDescriptor(description="Turn rate (rad/s)"))
        self.declare_parameter("autonomous_mode", False, ParameterDescriptor(description="Drive without a person"))


def main():
    rclpy.init()
    rclpy.spin(ExerciseRobot())


if __name__ == "__main__":
    main()
