"""Handler for the completion of an action."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.action import Action
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.execution_complete import ExecutionComplete

if TYPE_CHECKING:
    from launch.some_entities_type import SomeEntitiesType


class OnExecutionComplete(OnActionEventBase):
    """Handles the completion of an action."""

    def __init__(
        self,
        *,
        target_action: Action | Callable[[Action], bool] | None = None,
        on_completion: SomeEntitiesType | Callable[..., SomeEntitiesType | None],
        **kwargs: bool,
    ) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )
