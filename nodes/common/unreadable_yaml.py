"""The exceptions that reading YAML can raise."""

from __future__ import annotations

import yaml

UNREADABLE = (yaml.YAMLError, ValueError, TypeError, AttributeError, LookupError, OverflowError, RecursionError)
"""YAML's own errors, and those raised for invalid values of tags such as `!!timestamp` and for a document that contains
itself.
"""
