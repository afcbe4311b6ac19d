"""The exceptions that reading YAML may raise."""

from __future__ import annotations

import yaml

UNREADABLE = (yaml.YAMLError, ValueError, TypeError, AttributeError, LookupError, OverflowError, RecursionError)
"""Besides its own errors those of the values that tags such as `!!timestamp` make, and of a text that holds itself."""
