"""Handlers of the records of a launch, and those of the standard library by the same names."""

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
