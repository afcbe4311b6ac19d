"""Logging settings: the level, the formats, the screen, the main log file and files of processes."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Callable
from typing import TextIO

from bot_console.runtime.files.unwritable_log import LogFile
from launch.logging import formats
from launch.logging.formats import Format
from launch.logging.log_directory import new_run_directory

SCREEN_FORMAT = "OVERRIDE_LAUNCH_SCREEN_FORMAT"
LOG_FORMAT = "OVERRIDE_LAUNCH_LOG_FORMAT"


class ScreenHandler(logging.StreamHandler):  # pyright: ignore[reportMissingTypeArgument] -- generic for checkers only
    """Writes to the current `sys.stdout`."""

    def __init__(self) -> None:
        logging.Handler.__init__(self)

    @property
    def stream(self) -> TextIO:  # type: ignore[override] -- narrower than the base, which nobody minds here
        """The standard output."""
        return sys.stdout

    @stream.setter
    def stream(self, value: TextIO) -> None:
        raise AttributeError("the screen is always sys.stdout")

    def __repr__(self) -> str:
        return "<ScreenHandler>"


class LaunchConfig:
    """The settings; files and folders are created when the first line is written to them."""

    def __init__(self) -> None:
        self.level_hooks: list[Callable[[int], None]] = []
        """Called with a new level, as the loggers depend on the settings, not the settings on them."""
        self.reset()

    def reset(self) -> None:
        """Restore the defaults, with a new folder for this run."""
        for handler in getattr(self, "_files", {}).values():
            handler.close()
        self._level = logging.INFO
        self._log_dir: str | None = None
        self._files: dict[str, logging.Handler] = {}
        self._screen: logging.Handler | None = None
        self._screen_format = Format("default")
        self._log_format = Format("default")
        self.log_handler_factory: Callable[..., logging.Handler] = logging.FileHandler
        """Creates the handler of a log file from its path and `encoding=`."""

    @property
    def level(self) -> int:
        """Records below this level are dropped."""
        return self._level

    @level.setter
    def level(self, value: int) -> None:
        self._level = value
        for report in self.level_hooks:
            report(value)

    @property
    def log_dir(self) -> str:
        """The folder of this run."""
        if self._log_dir is None:
            self._log_dir = new_run_directory()
        return self._log_dir

    @log_dir.setter
    def log_dir(self, value: str | None) -> None:
        if value is not None and not os.path.isdir(value):
            raise ValueError(f"'{value}' is not a directory")
        self._log_dir = value

    def get_log_file_path(self, file_name: str = "launch.log") -> str:
        """Return the path of a log file of this run."""
        return os.path.join(self.log_dir, file_name)

    def set_screen_format(self, screen_format: str, *, screen_style: str | None = None) -> None:
        """Set the format of records on the screen: a name such as `default_with_timestamp`, or a format string.

        Raises `ValueError` for an unknown style, and for a style given with a name.
        """
        self._screen_format = Format.checked(screen_format, screen_style, formats.SCREEN)
        self._screen = None if self._screen is None else self._with_screen_format(self._screen)

    def set_log_format(self, log_format: str, *, log_style: str | None = None) -> None:
        """Set the format of records in the main log file; raises `ValueError` as `set_screen_format` does."""
        self._log_format = Format.checked(log_format, log_style, formats.LOG)

    def get_screen_handler(self) -> logging.Handler:
        """Return the handler that writes to the screen."""
        if self._screen is None:
            self._screen = self._with_screen_format(ScreenHandler())
        return self._screen

    @property
    def screen_handler(self) -> logging.Handler:
        """The handler that writes to the screen."""
        return self.get_screen_handler()

    @screen_handler.setter
    def screen_handler(self, handler: logging.Handler) -> None:
        self.set_screen_handler(handler)

    def set_screen_handler(self, handler: logging.Handler) -> None:
        """Replace the standard output as the screen, for a console that draws the screen itself."""
        self._screen = self._with_screen_format(handler)

    def get_log_file_handler(self, file_name: str = "launch.log") -> logging.Handler:
        """Return the handler of a log file of this run; the file is created with its first line."""
        if file_name not in self._files:
            path = self.get_log_file_path(file_name)
            if self.log_handler_factory is logging.FileHandler:
                handler: logging.Handler = LogFile(path, delay=True, encoding="utf-8")
            else:
                handler = self.log_handler_factory(path, encoding="utf-8")
            chosen = Format.overridden(LOG_FORMAT, self._log_format)
            handler.setFormatter(chosen.formatter(formats.LOG, formats.OUTPUT_IN_LOG))
            self._files[file_name] = handler
        return self._files[file_name]

    def _with_screen_format(self, handler: logging.Handler) -> logging.Handler:
        chosen = Format.overridden(SCREEN_FORMAT, self._screen_format)
        handler.setFormatter(chosen.formatter(formats.SCREEN, formats.OUTPUT_ON_SCREEN))
        return handler


launch_config = LaunchConfig()
"""The settings of this process."""
