"""Explains why a file cannot be loaded as parameters; upstream shows a traceback in most cases."""

from __future__ import annotations

import yaml
from yaml.parser import ParserError
from yaml.scanner import ScannerError

UNREADABLE = (
    *(OSError, RuntimeError, ValueError, TypeError, AttributeError, LookupError, OverflowError),
    yaml.YAMLError,
)
"""The exceptions that reading may raise: for the file, YAML, the values of its tags, or an unexpected structure."""


def is_bad_syntax(path: str, error: Exception) -> bool:
    """Whether the file is not YAML at all, in which case upstream's traceback is well known."""
    mark = getattr(error, "problem_mark", None)
    return isinstance(error, (ScannerError, ParserError)) and mark is not None and mark.name == path


def fault_of(path: str, error: Exception) -> str:
    """Return one line about an error that `rclpy.parameter.parameter_dict_from_yaml_file` raised for a file."""
    if isinstance(error, OSError):
        return f"{path}: {error.strerror or error}"
    if isinstance(error, RuntimeError) and not isinstance(error, RecursionError):
        return str(error)
    if isinstance(error, yaml.YAMLError):
        return f"{path}: {_not_yaml(path, error)}"
    if isinstance(error, RecursionError):
        return f"{path}: it is nested too deeply, or contains itself"
    if isinstance(error, UnicodeDecodeError):
        return f"{path}: it is not UTF-8 text"
    if isinstance(error, (ValueError, LookupError, OverflowError)):
        return f"{path}: a value does not match its tag, or a number has too many digits"
    return f"{path}: it is not a parameter file: 'NODE:', below it 'ros__parameters:', below that 'name: value'"


def _not_yaml(path: str, error: object) -> str:
    mark = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "it cannot be read"
    if path not in (getattr(mark, "name", None), getattr(error, "name", None)):
        return f"a string in it, which ROS parses as YAML again, is invalid: {problem}"
    return f"not YAML: line {mark.line + 1}: {problem}" if mark else f"not YAML: {problem}"
