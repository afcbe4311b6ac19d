"""What runs for an action that executes something: a process of the system, or a node process in this one."""

from launch.child.child import Child, Output
from launch.child.node_child import start_node_child
from launch.child.os_child import start_os_child

__all__ = ["Child", "Output", "start_node_child", "start_os_child"]
