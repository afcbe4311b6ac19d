"""Descriptions of nodes' parameters and of composable nodes."""

from launch_ros.descriptions.composable_lifecycle_node import ComposableLifecycleNode
from launch_ros.descriptions.composable_node import ComposableNode
from launch_ros.descriptions.parameter import Parameter
from launch_ros.descriptions.parameter_file import ParameterFile
from launch_ros.descriptions.parameter_value import ParameterValue

__all__ = ["ComposableLifecycleNode", "ComposableNode", "Parameter", "ParameterFile", "ParameterValue"]
