"""How a record looks on the screen and in a file."""

from __future__ import annotations

import logging

SCREEN = {
    "default": "[{levelname}] [{name}]: {message}",
    "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {message}",
}
LOG = {"default": "{created:.7f} [{levelname}] [{name}]: {message}"}
OUTPUT_ON_SCREEN = "{message}"
OUTPUT_IN_LOG = "{created:.7f} {message}"


class OutputAwareFormatter(logging.Formatter):
    """Writes records of launch in one format, and lines that a process has printed in another."""

    def __init__(self, launch_format: str, output_format: str) -> None:
        super().__init__(launch_format.replace("{msg}", "{message}"), style="{", validate=False)
        self._output = logging.Formatter(output_format, style="{")

    def format(self, record: logging.LogRecord) -> str:
        """The text of a record."""
        if getattr(record, "is_process_output", False):
            return self._output.format(record)
        return super().format(record)
