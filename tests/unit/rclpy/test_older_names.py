"""Former names by which programs import things that have moved."""

from __future__ import annotations

import importlib
import sys

import pytest
import rclpy.exceptions


def test_exceptions_can_be_imported_from_the_c_extension() -> None:
    from rclpy.impl.implementation_singleton import rclpy_implementation

    assert issubclass(rclpy_implementation.RCLError, RuntimeError)
    assert issubclass(rclpy_implementation.NotImplementedError, NotImplementedError)
    assert rclpy_implementation.InvalidHandle is rclpy.exceptions.InvalidHandle


def test_invalid_handle_can_be_imported_from_the_handle_module() -> None:
    from rclpy.handle import InvalidHandle

    assert InvalidHandle is rclpy.exceptions.InvalidHandle


def test_qos_event_warns_and_has_the_same_classes() -> None:
    sys.modules.pop("rclpy.qos_event", None)
    with pytest.warns(UserWarning, match="importing 'qos_event' is deprecated; import 'event_handler' instead"):
        old = importlib.import_module("rclpy.qos_event")
    from rclpy import event_handler

    assert old.SubscriptionEventCallbacks is event_handler.SubscriptionEventCallbacks
    assert old.QoSEventHandler is event_handler.EventHandler
    assert old.QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED == 5


def test_lifecycle_has_short_names() -> None:
    from rclpy import lifecycle

    assert lifecycle.NodeMixin is lifecycle.LifecycleNodeMixin
