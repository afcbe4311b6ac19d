"""Loggers of launch, in a tree of their own: records that nodes in this process log with `logging` are unaffected."""

from __future__ import annotations

import logging

from launch.logging.config import launch_config


class LaunchLogger(logging.Logger):
    """A logger whose records go to the screen and to `launch.log`, which are opened on the first record."""

    def callHandlers(self, record: logging.LogRecord) -> None:
        """Pass the record to the logger's own handlers, then to the screen and the log file."""
        for handler in self.handlers:
            if record.levelno >= handler.level:
                handler.handle(record)
        if self.propagate:
            for handler in (launch_config.get_screen_handler(), launch_config.get_log_file_handler()):
                if record.levelno >= handler.level and handler not in self.handlers:
                    handler.handle(record)

    def hasHandlers(self) -> bool:
        """Return True."""
        return True


def get_logger(name: str | None = None) -> LaunchLogger:
    """Return the logger with a name; without a name, the root logger."""
    if name is None:
        return _root
    logger = _manager.getLogger(name)
    assert isinstance(logger, LaunchLogger)
    return logger


def set_level(level: int) -> None:
    """Drop records below a level, in all loggers that have no level of their own."""
    _root.setLevel(level)
    _manager._clear_cache()  # type: ignore[attr-defined] -- the standard library itself calls it so


def reset_loggers() -> None:
    """Discard all loggers."""
    _manager.loggerDict.clear()
    set_level(logging.INFO)


_root = LaunchLogger("root", logging.INFO)
_manager = logging.Manager(_root)  # type: ignore[arg-type] -- the standard library itself calls it so
_manager.setLoggerClass(LaunchLogger)
launch_config.level_hooks.append(set_level)
