"""Formats of records on the screen and in files."""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping
from typing import NamedTuple

SCREEN = {
    "default": "[{levelname}] [{name}]: {message}",
    "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {message}",
}
LOG = {"default": "{created:.7f} [{levelname}] [{name}]: {message}"}
OUTPUT_ON_SCREEN = "{message}"
OUTPUT_IN_LOG = "{created:.7f} {message}"


class Format(NamedTuple):
    """A record format, given by its text or its name, with the style of its fields (`{`, `%` or `$`)."""

    text: str
    style: str = "{"

    @classmethod
    def checked(cls, text: str, style: str | None, names: Mapping[str, str]) -> Format:
        """Return a format; raises `ValueError` for a style given with a name, and for an unknown style."""
        if style is None:
            return cls(text)
        if text in names:
            raise ValueError("Cannot set a custom format style for a format alias")
        if style not in ("{", "%", "$"):
            raise ValueError(f"'{style}' is not a format style, i.e. one of {{ % $")
        return cls(text, style)

    @classmethod
    def overridden(cls, variable: str, own: Format) -> Format:
        """Return the format that an environment variable sets, or else `own`."""
        given = os.environ.get(variable)
        return cls(given) if given else own

    def formatter(self, names: Mapping[str, str], output_format: str) -> logging.Formatter:
        """Return a formatter with this format for records, and another format for the output of processes."""
        return OutputAwareFormatter(names.get(self.text, self.text), output_format, self.style)


class OutputAwareFormatter(logging.Formatter):
    """Formats launch's own records one way, and output of processes another."""

    def __init__(self, launch_format: str, output_format: str, style: str = "{") -> None:
        super().__init__(launch_format.replace("{msg}", "{message}"), style=style, validate=False)  # type: ignore -- a word that the caller has checked
        self._output = logging.Formatter(output_format, style="{")

    def format(self, record: logging.LogRecord) -> str:
        """Format a record."""
        if getattr(record, "is_process_output", False):
            return self._output.format(record)
        return super().format(record)
