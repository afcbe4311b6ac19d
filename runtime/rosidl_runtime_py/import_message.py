"""Imports message classes by their namespaced type."""

from __future__ import annotations

import importlib
import warnings
from typing import Any

from rosidl_parser.definition import NamespacedType


def import_message_from_namespaced_type(message_type: Any) -> Any:
    """Return the class of a `NamespacedType`; raises `ImportError` or `AttributeError` if there is none."""
    if not isinstance(message_type, NamespacedType) and hasattr(message_type, "value_type"):
        message_type = message_type.value_type
        warnings.warn(
            "Passing objects containing a NamespacedType is deprecated, please pass a NamespacedType object directly",
            DeprecationWarning,
            stacklevel=2,
        )
    module = importlib.import_module(".".join(message_type.namespaces))
    action, _, rest = message_type.name.partition("_")
    if rest == "FeedbackMessage":
        return getattr(module, action).Impl.FeedbackMessage
    return getattr(module, message_type.name)
