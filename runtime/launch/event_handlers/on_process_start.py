"""Handler for the start of a process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessStarted

if TYPE_CHECKING:
    from launch.action import Action
    from launch.some_entities_type import SomeEntitiesType


class OnProcessStart(OnActionEventBase):
    """Handles the start of a process."""

    def __init__(
        self,
        *,
        target_action: Action | Callable[[Action], bool] | None = None,
        on_start: SomeEntitiesType | Callable[..., SomeEntitiesType | None],
        **kwargs: bool,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
