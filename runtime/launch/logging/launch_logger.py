"""Loggers of launch, in a tree of their own: what nodes in this process log with `logging` stays theirs."""

from __future__ import annotations

import logging

from launch.logging.config import launch_config


class LaunchLogger(logging.Logger):
    """A logger whose records go to the screen and to `launch.log`, each found when the first record comes."""

    def callHandlers(self, record: logging.LogRecord) -> None:
        """Hand the record to handlers of its own, then to the screen and the log file."""
        for handler in self.handlers:
            if record.levelno >= handler.level:
                handler.handle(record)
        if self.propagate:
            for handler in (launch_config.get_screen_handler(), launch_config.get_log_file_handler()):
                if record.levelno >= handler.level and handler not in self.handlers:
                    handler.handle(record)

    def hasHandlers(self) -> bool:
        """True."""
        return True


def get_logger(name: str | None = None) -> LaunchLogger:
    """The logger of a name; without a name the root of all."""
    if name is None:
        return _root
    logger = _manager.getLogger(name)
    assert isinstance(logger, LaunchLogger)
    return logger


def set_level(level: int) -> None:
    """Drop records below a level, in all loggers that have none of their own."""
    _root.setLevel(level)
    _manager._clear_cache()  # type: ignore[attr-defined] -- the standard library itself calls it so


def reset_loggers() -> None:
    """Forget all loggers."""
    _manager.loggerDict.clear()
    set_level(logging.INFO)


_root = LaunchLogger("root", logging.INFO)
_manager = logging.Manager(_root)  # type: ignore[arg-type] -- the standard library itself calls it so
_manager.setLoggerClass(LaunchLogger)
launch_config.level_hooks.append(set_level)
