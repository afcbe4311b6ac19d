"""Split a process's output into lines for its loggers."""

from __future__ import annotations

import codecs
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from logging import Logger

    from launch.action import Action


class OutputLines:
    """Collects the text of one stream and logs each line as soon as it is complete."""

    def __init__(self, action: Action, logger: Logger, output_format: str) -> None:
        self._action = action
        self._logger = logger
        self._format = output_format
        self._decode = codecs.getincrementaldecoder("utf-8")(errors="replace").decode
        self._unfinished = ""

    def feed(self, data: bytes) -> None:
        """Handle received bytes: log the lines that they complete."""
        *lines, self._unfinished = (self._unfinished + self._decode(data)).split("\n")
        for line in lines:
            self._log(line)

    def flush(self) -> None:
        """Log an unterminated last line."""
        rest, self._unfinished = self._unfinished, ""
        if rest:
            self._log(rest)

    def _log(self, line: str) -> None:
        self._logger.info(self._format.format(line=line, this=self._action))
