"""Parameters, parameter files and typed values in launch files."""

from launch_ros.descriptions.parameter import Parameter
from launch_ros.descriptions.parameter_file import ParameterFile
from launch_ros.descriptions.parameter_value import ParameterValue

__all__ = ["Parameter", "ParameterFile", "ParameterValue"]
