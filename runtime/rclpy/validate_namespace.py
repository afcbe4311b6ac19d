"""Validation of namespaces."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy._rclpy_pybind11 import RMWError
from rclpy.exceptions import InvalidNamespaceException


def validate_namespace(namespace: str) -> bool:
    """Return True for a valid, absolute namespace; raises `InvalidNamespaceException`."""
    if namespace is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RMWError("failed to validate namespace: error not set")
    problem = names.validate_namespace(namespace)
    if problem:
        raise InvalidNamespaceException(namespace, *problem)
    return True
