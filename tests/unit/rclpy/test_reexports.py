"""Names that programs import from modules which only re-export them, and modules used without an import."""

from __future__ import annotations

import importlib
import subprocess
import sys

import pytest
import rclpy.node

TAKEN_FROM = {
    "rclpy.node": {
        "ParameterDescriptor": "rcl_interfaces.msg",
        "ParameterType": "rcl_interfaces.msg",
        "Parameter": "rclpy.parameter",
        "Publisher": "rclpy.publisher",
        "QoSProfile": "rclpy.qos",
        "ReentrantCallbackGroup": "rclpy.callback_groups",
        "SetParametersResult": "rcl_interfaces.msg",
        "Subscription": "rclpy.subscription",
        "Timer": "rclpy.timer",
    },
    "rclpy.clock": {"Duration": "rclpy.duration", "Time": "rclpy.time"},
    "rclpy.executors": {"Future": "rclpy.task", "Timer": "rclpy.timer"},
    "rclpy.qos": {"Duration": "rclpy.duration"},
    "rclpy.lifecycle.node": {"Publisher": "rclpy.publisher", "TransitionCallbackReturn": "rclpy.lifecycle"},
    "rclpy.action.client": {"GoalStatus": "action_msgs.msg"},
    "rclpy.event_handler": {"QoSEventHandler": "rclpy.qos_event"},
    "rclpy.parameter": {"ParameterType": "rcl_interfaces.msg"},
    "rclpy.parameter_client": {"ParameterEvent": "rcl_interfaces.msg"},
    "rclpy.publisher": {"PublisherEventCallbacks": "rclpy.event_handler"},
    "rclpy.subscription": {"SubscriptionEventCallbacks": "rclpy.event_handler"},
    "rclpy.time_source": {"ClockType": "rclpy.clock_type"},
}


@pytest.mark.parametrize(
    ("module", "name", "home"),
    [(module, name, home) for module, names in TAKEN_FROM.items() for name, home in names.items()],
)
def test_reexported_name_is_the_original(module: str, name: str, home: str) -> None:
    found = getattr(importlib.import_module(module), name)
    assert found is getattr(importlib.import_module(home), name)


def test_message_class_is_available_as_parameter_msg() -> None:
    from rcl_interfaces.msg import Parameter
    from rclpy.parameter import ParameterMsg

    assert rclpy.node.ParameterMsg is ParameterMsg is Parameter


def test_c_extension_is_available_by_its_short_name() -> None:
    from rclpy import _rclpy_pybind11
    from rclpy.node import _rclpy

    assert _rclpy is _rclpy_pybind11


def test_unknown_name_raises_pythons_error() -> None:
    with pytest.raises(AttributeError, match=r"^module 'rclpy\.node' has no attribute 'Sausage'$"):
        _ = rclpy.node.Sausage
    with pytest.raises(ImportError, match=r"cannot import name 'Sausage' from 'rclpy\.node'"):
        from rclpy.node import Sausage  # noqa: F401
    with pytest.raises(AttributeError, match=r"^module 'rclpy' has no attribute 'sausage'$"):
        _ = rclpy.sausage


SCRIPT = """
from bot_console.runtime.importer import install
install()
import rclpy
print(hasattr(rclpy, 'exceptions'), hasattr(rclpy, 'executors'), hasattr(rclpy, 'node'))
from rclpy.node import Node
print(rclpy.executors.MultiThreadedExecutor.__name__, rclpy.time.Time().nanoseconds, hasattr(rclpy, 'action'))
"""


def test_submodules_exist_once_upstream_would_have_loaded_them() -> None:
    reported = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, timeout=240)
    assert reported.stdout.splitlines() == ["True False False", "MultiThreadedExecutor 0 False"]


def test_events_executor_serves_callbacks(ros: object) -> None:
    from rclpy.experimental import EventsExecutor
    from rclpy.experimental.events_executor import EventsExecutor as FromItsModule

    assert EventsExecutor is FromItsModule
    with EventsExecutor(context=ros.init()) as executor:  # type: ignore[attr-defined]
        task = executor.create_task(lambda: 3)
        executor.spin_once(timeout_sec=5)
    assert task.result() == 3
