"""Running actions after a delay on the ROS clock."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.actions import TimerAction
from launch.events import TimerEvent
from launch.frontend import expose_action
from launch_ros.ros_adapters import get_ros_node

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("ros_timer")
class ROSTimer(TimerAction):
    """Visits actions after a period (s) of ROS time, which follows `/clock` if `SetUseSimTime` requests that."""

    def __init__(self, *, period: float | SomeSubstitutionsType, actions: Iterable[Action], **kwargs: Any) -> None:
        super().__init__(period=period, actions=actions, **kwargs)
        self.__timer: Any = None

    def _wait(self, context: LaunchContext, period: float) -> None:
        node = get_ros_node(context)
        loop = context.asyncio_loop
        event = TimerEvent(timer_action=self)

        def fired() -> None:
            self.__timer.cancel()
            loop.call_soon_threadsafe(context.emit_event_sync, event)

        self.__timer = node.create_timer(period, fired, clock=node.get_clock())

    def cancel(self) -> None:
        """Cancel the timer."""
        if self.__timer is not None:
            self.__timer.cancel()
        super().cancel()


RosTimer = ROSTimer
