"""The log file of a process if `ROS_LOG_DIR` is set, named and formatted as by rcl_logging_spdlog.

Without that variable there is no log file, whereas upstream writes one for each run of each program to `~/.ros/log`.
"""

from __future__ import annotations

import contextlib
import os
import sys
from typing import TYPE_CHECKING, TextIO

from bot_console.runtime.process import current
from rclpy.impl.log_format import Formatter

if TYPE_CHECKING:
    from bot_console.runtime.rmw.arguments import Arguments

MS_TO_NS = 1_000_000


class LogFile:
    """Receives the log messages of a process while any of its contexts exists.

    The file is created with the first message, so that a program that logs nothing leaves none.
    """

    def __init__(self) -> None:
        self.is_wanted = False
        self._path = ""
        self._stream: TextIO | None = None
        self._formatter: Formatter | None = None
        self._contexts = 0

    def begin(self, arguments: Arguments) -> None:
        """Register a new context; the first one chooses the file. Raises `OSError` if its folder cannot be created.

        The file name begins with `--log-file-name`, or by default with the interpreter's name.
        """
        given = os.environ.get("ROS_LOG_DIR")
        if not self._contexts and given and arguments.external_logs_enabled:
            folder = os.path.abspath(os.path.expanduser(given))
            os.makedirs(folder, exist_ok=True)
            process = current()
            first = arguments.log_file_name or os.path.basename(sys.executable) or "python3"
            name = f"{first}_{process.pid}_{process.clock.system_ns() // MS_TO_NS}.log"
            self._path = os.path.join(folder, name)
            self._formatter = Formatter.of_environment(enveloped=False)
            self.is_wanted = True
        self._contexts += 1

    def end(self) -> None:
        """Unregister an ended context; the last one closes the file."""
        self._contexts -= 1
        if not self._contexts:
            self._close()

    def write(
        self, severity: int, name: str, text: str, file: str, function: str, line: int, stamp_ns: int, on_rosout: bool
    ) -> None:
        """Write a message at once; the first write that fails ends the log file."""
        formatter = self._formatter
        if not self.is_wanted or formatter is None:
            return
        try:
            if self._stream is None:
                os.makedirs(os.path.dirname(self._path), exist_ok=True)  # `--log-file-name` may contain folders
                self._stream = open(self._path, "a", 1, "utf-8", "backslashreplace")  # noqa: SIM115 -- until `_close`
            self._stream.write(formatter.line(severity, name, text, file, function, line, stamp_ns, on_rosout) + "\n")
        except (OSError, ValueError) as error:  # a full disk, or closed by another thread
            if self.is_wanted:
                self._close()
                print(f"[WARN] [rcl_logging]: nothing more is logged to {self._path}: {error}", file=sys.stderr)

    def _close(self) -> None:
        self.is_wanted = False
        stream, self._stream = self._stream, None
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.close()
