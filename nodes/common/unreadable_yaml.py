"""The exceptions that reading YAML can raise."""

from __future__ import annotations

import yaml

UNREADABLE = (yaml.YAMLError, ValueError, TypeError, AttributeError, LookupError, OverflowError, RecursionError)
"""Besides YAML's own errors, those raised for values of tags such as `!!timestamp` and for a document that contains
itself.
"""
