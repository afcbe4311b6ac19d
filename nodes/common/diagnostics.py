"""Diagnostic messages: one status with named values."""

from __future__ import annotations

from collections.abc import Mapping

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

OK = DiagnosticStatus.OK
WARN = DiagnosticStatus.WARN
ERROR = DiagnosticStatus.ERROR


def status(name: str, level: bytes, message: str, values: Mapping[str, object], stamp: Time) -> DiagnosticArray:
    """Return an array with one status; numbers have up to four decimals."""
    pairs = [KeyValue(key=key, value=_text(value)) for key, value in values.items()]
    array = DiagnosticArray()
    array.header.stamp = stamp
    array.status = [DiagnosticStatus(level=level, name=name, message=message, hardware_id="robot", values=pairs)]
    return array


def _text(value: object) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".") if isinstance(value, float) else str(value)
