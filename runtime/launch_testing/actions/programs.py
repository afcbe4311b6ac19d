"""Programs under test: any program, a GTest program, and a pytest file."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING, Any

from launch.actions import EmitEvent, ExecuteProcess, TimerAction
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.substitutions import FindExecutable

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType


class Test(ExecuteProcess):
    """A process that is killed if it has not ended after `timeout` seconds."""

    __test__ = False  # pytest must not collect this class

    def __init__(self, *, timeout: float | SomeSubstitutionsType | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__timeout = timeout

    @property
    def timeout(self) -> float | SomeSubstitutionsType | None:
        """The timeout in seconds; None for no limit."""
        return self.__timeout

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the process and the timeout."""
        actions = super().execute(context)
        if not self.__timeout:
            return actions
        kill = EmitEvent(event=SignalProcess(signal_number=signal.SIGKILL, process_matcher=matches_action(self)))
        return [*(actions or []), TimerAction(period=self.__timeout, actions=[kill])]


class GTest(Test):
    """A GTest program."""

    def __init__(self, *, path: object, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self.__path = path

    @property
    def path(self) -> Any:
        """The path of the program."""
        return self.__path


class PyTest(Test):
    """A file of tests for pytest."""

    def __init__(self, *, path: object, **kwargs: Any) -> None:
        super().__init__(cmd=[FindExecutable(name="python3"), "-m", "pytest", path], **kwargs)
        self.__path = path

    @property
    def path(self) -> Any:
        """The path of the file."""
        return self.__path
