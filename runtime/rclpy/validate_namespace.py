"""Validation of namespaces."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy.exceptions import InvalidNamespaceException


def validate_namespace(namespace: str) -> bool:
    """True for a valid, absolute namespace; raises `InvalidNamespaceException`."""
    problem = names.validate_namespace(namespace)
    if problem:
        raise InvalidNamespaceException(namespace, *problem)
    return True
