"""Handler for the output of a process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessIO

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnProcessIO(OnActionEventBase):
    """Handles the input and output of a process; each callable gets the event."""

    def __init__(
        self,
        *,
        target_action: Action | Callable[[Action], bool] | None = None,
        on_stdin: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stdout: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stderr: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        **kwargs: bool,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        def on_io(event: Any, context: LaunchContext) -> SomeEntitiesType | None:
            for is_it, callback in (
                (event.from_stdout, on_stdout),
                (event.from_stderr, on_stderr),
                (event.from_stdin, on_stdin),
            ):
                if is_it and callback is not None:
                    return callback(event)
            return None

        super().__init__(
            action_matcher=target_action,
            on_event=on_io,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
