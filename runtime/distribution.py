"""The ROS 2 distribution whose answers the runtime gives: Jazzy's, or those that `BOT_CONSOLE_DISTRO` names.

All differences between the distributions are in one table; the rest of the runtime asks it, and knows no distribution.
A process has one distribution from its start to its end.
"""

from __future__ import annotations

import os
from enum import Enum, IntEnum
from functools import cache
from typing import NamedTuple

VARIABLE = "BOT_CONSOLE_DISTRO"


class Distribution(NamedTuple):
    """The differences between the distributions."""

    name: str
    parameter_type_base: type[Enum]
    """The base of `Parameter.Type`; as whole numbers, types print as numbers, in refusals, too."""
    init_is_context_manager: bool
    """Whether `with rclpy.init():` shuts down at its end; else `init` returns None."""
    error_before_init: type[Exception]
    """The exception that making an executor raises before `rclpy.init()`."""
    second_shutdown: tuple[str, str]
    """Type and text of the error of a context's second shutdown."""
    newest_task_first: bool
    """Whether of several tasks that are ready the newest runs first."""
    closed_executor_takes_work: bool
    """Whether nodes and tasks can be added to an executor that was shut down."""
    invalid_transition_ends_node: bool
    """Whether a lifecycle transition that does not exist raises; else it is logged, and answered as failed."""
    durations_add_up: bool
    """Whether durations can be added, subtracted, and multiplied by a number."""
    warn_is_deprecated: bool
    """Whether `logger.warn` warns that it is deprecated."""
    invalid_qos_prefix: tuple[str, ...]
    """The arguments of `InvalidQoSProfileException` before the reason."""
    has_rosout_preset: bool
    """Whether there are `qos_profile_rosout_default` and its preset."""


TABLE = {
    each.name: each
    for each in (
        Distribution(
            name="jazzy",
            parameter_type_base=Enum,
            init_is_context_manager=False,
            error_before_init=TypeError,
            second_shutdown=("RCLError", "failed to shutdown: rcl_shutdown already called on the given context"),
            newest_task_first=True,
            closed_executor_takes_work=False,
            invalid_transition_ends_node=True,
            durations_add_up=False,
            warn_is_deprecated=False,
            invalid_qos_prefix=("Invalid QoSProfile",),
            has_rosout_preset=False,
        ),
        Distribution(
            name="kilted",
            parameter_type_base=IntEnum,
            init_is_context_manager=True,
            error_before_init=RuntimeError,
            second_shutdown=("RuntimeError", "Context already shutdown."),
            newest_task_first=False,
            closed_executor_takes_work=True,
            invalid_transition_ends_node=False,
            durations_add_up=True,
            warn_is_deprecated=True,
            invalid_qos_prefix=(),
            has_rosout_preset=True,
        ),
    )
}
DEFAULT = TABLE["jazzy"]


class UnknownDistributionError(ValueError):
    """There is no distribution of the given name."""

    def __init__(self, name: str, source: str) -> None:
        super().__init__(f"{source}: there is no distribution '{name}' here; choose {' or '.join(TABLE)}")


@cache
def distribution() -> Distribution:
    """The distribution of this process; raises `UnknownDistributionError`."""
    name = os.environ.get(VARIABLE, "")
    if name and name not in TABLE:
        raise UnknownDistributionError(name, VARIABLE)
    return TABLE[name] if name else DEFAULT


def choose(name: str, source: str) -> None:
    """Choose the distribution of this process and of those that it starts, before anything asks for it.

    Raises `UnknownDistributionError`, which names the `source` of the choice.
    """
    if name not in TABLE:
        raise UnknownDistributionError(name, source)
    os.environ[VARIABLE] = name
    os.environ["ROS_DISTRO"] = name
