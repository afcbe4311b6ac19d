"""Handlers of a launch's records, and the standard library's under the same names."""

from logging import FileHandler, Handler, StreamHandler
from logging.handlers import (
    RotatingFileHandler,
    SysLogHandler,
    TimedRotatingFileHandler,
    WatchedFileHandler,
)

from launch.logging.config import ScreenHandler

__all__ = [
    "FileHandler",
    "Handler",
    "RotatingFileHandler",
    "ScreenHandler",
    "StreamHandler",
    "SysLogHandler",
    "TimedRotatingFileHandler",
    "WatchedFileHandler",
]
