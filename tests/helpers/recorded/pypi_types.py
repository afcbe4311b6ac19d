"""Runs before a recorded case on the rclpy of PyPI, and replaces the types of `example_interfaces`, which PyPI lacks.

`test_msgs` has the same Fibonacci action. There is no service like AddTwoInts: cases that need it cannot run there.
Other missing types are provided in the same way as for `bot-console attach --ros`.
"""

import sys
import types

import test_msgs.action
from bot_console.tui.session.machine.console_needs import provide_missing

provide_missing()
example_interfaces = types.ModuleType("example_interfaces")
action = types.ModuleType("example_interfaces.action")
vars(action)["Fibonacci"] = test_msgs.action.Fibonacci
sys.modules.update({"example_interfaces": example_interfaces, "example_interfaces.action": action})
