"""The ROS 2 distribution as which the runtime behaves: Jazzy, or the one that `BOT_CONSOLE_DISTRO` names.

All differences between the distributions are in one table, which the rest of the runtime queries without knowing the
distributions. The distribution of a process never changes.
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
    """The base of `Parameter.Type`; with an integer base, types print as numbers, even in messages about refusals."""
    init_is_context_manager: bool
    """Whether `with rclpy.init():` shuts down at its end; otherwise `init` returns None."""
    error_before_init: type[Exception]
    """The exception for creating an executor before `rclpy.init()`."""
    second_shutdown: tuple[str, str]
    """Type and text of the error when a context is shut down a second time."""
    newest_task_first: bool
    """Whether the newest of several ready tasks runs first."""
    closed_executor_takes_work: bool
    """Whether nodes and tasks can be added to an executor that was shut down."""
    invalid_transition_ends_node: bool
    """Whether a lifecycle transition that does not exist raises; otherwise it is logged, and answered as failed."""
    durations_add_up: bool
    """Whether durations can be added, subtracted, and multiplied by a number."""
    warn_is_deprecated: bool
    """Whether `logger.warn` warns that it is deprecated."""
    invalid_qos_prefix: tuple[str, ...]
    """The arguments of `InvalidQoSProfileException` that precede the reason."""
    has_rosout_preset: bool
    """Whether `qos_profile_rosout_default` and its preset exist."""


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
    """There is no distribution with the given name."""

    def __init__(self, name: str, source: str) -> None:
        super().__init__(f"{source}: there is no distribution '{name}' here; choose {' or '.join(TABLE)}")


@cache
def distribution() -> Distribution:
    """Return the distribution of this process; raises `UnknownDistributionError`."""
    name = os.environ.get(VARIABLE, "")
    if name and name not in TABLE:
        raise UnknownDistributionError(name, VARIABLE)
    return TABLE[name] if name else DEFAULT


def choose(name: str, source: str) -> None:
    """Choose the distribution of this process and of those that it starts, before anything queries it.

    Raises `UnknownDistributionError`, which names the `source` of the choice.
    """
    if name not in TABLE:
        raise UnknownDistributionError(name, source)
    os.environ[VARIABLE] = name
    os.environ["ROS_DISTRO"] = name
