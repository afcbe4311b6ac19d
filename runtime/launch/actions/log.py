"""Logging at a level: actions of ROS 2 Kilted that public launch files already use."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

import launch.logging
from launch.actions.log_info import LogInfo, Message
from launch.frontend.expose import expose_action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

LEVELS = {name: getattr(logging, name) for name in ("NOTSET", "DEBUG", "INFO", "WARNING", "ERROR", "CRITICAL")}

__all__ = ["Log", "LogDebug", "LogError", "LogInfo", "LogWarning"]


class Log(Message):
    """Logs a message at a level, such as `debug` or `WARNING`."""

    def __init__(self, *, msg: SomeSubstitutionsType, level: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(msg=msg, **kwargs)
        self.__level = normalize_to_list_of_substitutions(level)

    @property
    def level(self) -> list[Substitution]:
        """The name of the level."""
        return self.__level

    def execute(self, context: LaunchContext) -> None:
        """Log the message; raises `KeyError` for an unknown level."""
        level = perform_substitutions(context, self.__level).upper()
        if level not in LEVELS:
            raise KeyError(f"Invalid log level '{level}', expected: {LEVELS.keys()}")
        text = perform_substitutions(context, self.msg)
        launch.logging.get_logger("launch.user").log(LEVELS[level], "%s", text)


@expose_action("log_debug")
class LogDebug(Log):
    """Logs a message that is shown only with `--debug`."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(msg=msg, level="DEBUG", **kwargs)


@expose_action("log_warning")
class LogWarning(Log):
    """Logs a warning."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(msg=msg, level="WARNING", **kwargs)


@expose_action("log_error")
class LogError(Log):
    """Logs an error."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(msg=msg, level="ERROR", **kwargs)
