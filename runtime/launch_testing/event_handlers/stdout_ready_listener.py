"""Runs actions when a process reports that it is ready."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers import OnProcessIO

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_description_entity import LaunchDescriptionEntity


class StdoutReadyListener(OnProcessIO):
    """Runs actions whenever a process, or for None any process, prints a chunk containing a text to standard output."""

    def __init__(
        self, *, target_action: Action | None = None, ready_txt: str, actions: list[LaunchDescriptionEntity]
    ) -> None:
        def actions_if_ready(event: Any) -> Any:
            return actions if ready_txt in event.text.decode() else None

        super().__init__(target_action=target_action, on_stdout=actions_if_ready)
        self.__actions = actions

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description, and the actions."""
        return super().describe()[0], self.__actions
