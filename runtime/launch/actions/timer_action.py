"""Running actions after a delay."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Iterable, Mapping
from copy import copy
from typing import TYPE_CHECKING

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.pop_launch_configurations import PopLaunchConfigurations
from launch.actions.push_launch_configurations import PushLaunchConfigurations
from launch.event_handler import EventHandler
from launch.event_handlers import OnShutdown
from launch.events import TimerEvent
from launch.frontend.expose import expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import create_future, ensure_argument_type, normalize_to_list_of_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("timer")
class TimerAction(Action):
    """Visits actions after a period (s), with the locals and launch configurations from when the timer was started.

    Changes that the actions make to configurations stay theirs; configurations created meanwhile are visible.
    """

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[Action],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        ensure_argument_type(period, (*SomeSubstitutionsType_types_tuple, float), "period", "TimerAction")
        ensure_argument_type(actions, Iterable, "actions", "TimerAction")
        if isinstance(period, str):
            warnings.warn(
                "The parameter 'period' must be a float or substitution,passing a string literal was deprecated",
                stacklevel=2,
            )
            period = normalize_to_list_of_substitutions(period)
        self.__period = normalize_typed_substitution(period, float)
        self.__actions = actions
        self.__cancel_on_shutdown = normalize_typed_substitution(cancel_on_shutdown, bool)
        self.__locals: dict[str, object] = {}
        self.__configurations: dict[str, object] = {}
        self.__canceled = False
        self._completed_future: asyncio.Future[None] | None = None
        self._handle: asyncio.TimerHandle | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[TimerAction], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["period"] = parser.parse_if_substitutions(entity.get_attr("period", data_type=float, can_be_str=True))
        cancel = entity.get_attr("cancel_on_shutdown", optional=True, data_type=bool, can_be_str=True)
        if cancel is not None:
            kwargs["cancel_on_shutdown"] = parser.parse_if_substitutions(cancel)
        kwargs["actions"] = [parser.parse_action(each) for each in entity.children]
        return cls, kwargs

    @property
    def period(self) -> float | list[Substitution]:
        """The period (s)."""
        return self.__period

    @property
    def actions(self) -> Iterable[Action]:
        """The actions."""
        return self.__actions

    def describe(self) -> str:
        """Return a short description."""
        return f"TimerAction(period={self.__period}, actions=<actions>)"

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the actions, with their condition."""
        return [(f"{self.__period} seconds pass without being canceled", list(self.__actions))]

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return a future that is done when the actions were visited or the timer was cancelled."""
        return self._completed_future

    def execute(self, context: LaunchContext) -> None:
        """Start the timer."""
        self.__locals = dict(context.get_locals_as_dict())
        self.__configurations = _copy_configurations(context.launch_configurations)
        period = perform_typed_substitution(context, self.__period, float)
        self._completed_future = create_future(context.asyncio_loop)
        cancel_on_shutdown = perform_typed_substitution(context, self.__cancel_on_shutdown, bool)
        if self.__canceled or (cancel_on_shutdown and context.is_shutdown):  # upstream ignores shutdown here
            self._completed_future.set_result(None)
            return
        self._handler = EventHandler(
            matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is self,
            entities=None,
        )
        self._handler.kind_of_events = TimerEvent
        self._handler.handle = self._handle_fired  # type: ignore[method-assign] -- this handler alone, as upstream
        context.register_event_handler(self._handler)
        if cancel_on_shutdown:
            context.register_event_handler(OnShutdown(on_shutdown=self._launch_ends))
        self._wait(context, max(0.0, period))

    def _launch_ends(self, event: object, context: LaunchContext) -> None:
        self.cancel()

    def _wait(self, context: LaunchContext, period: float) -> None:
        """Emit the timer's event after a period (s)."""
        event = TimerEvent(timer_action=self)
        self._handle = context.asyncio_loop.call_later(period, context.emit_event_sync, event)

    def _handle_fired(self, event: object, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        if self._completed_future is None or self._completed_future.done():
            return []
        context.unregister_event_handler(self._handler)
        self._completed_future.set_result(None)
        return self.handle(context)

    def handle(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions, in a scope with the locals and configurations of the timer's start."""
        context.extend_locals(self.__locals)
        restore = OpaqueFunction(function=self._restore_configurations)
        return [PushLaunchConfigurations(), restore, *self.__actions, PopLaunchConfigurations()]

    def _restore_configurations(self, context: LaunchContext) -> None:
        context.launch_configurations.update(
            _copy_configurations({**context.launch_configurations, **self.__configurations})
        )

    def cancel(self) -> None:
        """Cancel the timer."""
        self.__canceled = True
        if self._handle is not None:
            self._handle.cancel()
        if self._completed_future is not None and not self._completed_future.done():
            self._completed_future.set_result(None)


def _copy_configurations(configurations: Mapping[str, object]) -> dict[str, object]:
    """Return a copy that shares no list, as launch_ros appends to the lists of `SetParameter` and `SetRemap`."""
    return {name: copy(value) for name, value in configurations.items()}
