"""The definitions that are derived from a service or an action."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.runtime.rosidl.definition import Definition, Field, Interface, Type

GOAL_ID = Field("goal_id", Type("unique_identifier_msgs/UUID"))


def companions(interface: Interface) -> Sequence[Definition]:
    """Return the event of a service, or the services, their events and the feedback message of an action."""
    package, name = interface.package, interface.name
    if interface.kind == "srv":
        return [_event(package, name)]
    if interface.kind == "action":
        send = [
            Definition(f"{name}_SendGoal_Request", [GOAL_ID, Field("goal", Type(f"{package}/{name}_Goal"))]),
            Definition(
                f"{name}_SendGoal_Response",
                [Field("accepted", Type("boolean")), Field("stamp", Type("builtin_interfaces/Time"))],
            ),
        ]
        get = [
            Definition(f"{name}_GetResult_Request", [GOAL_ID]),
            Definition(
                f"{name}_GetResult_Response",
                [Field("status", Type("int8")), Field("result", Type(f"{package}/{name}_Result"))],
            ),
        ]
        feedback = [GOAL_ID, Field("feedback", Type(f"{package}/{name}_Feedback"))]
        return [
            *send,
            _event(package, f"{name}_SendGoal"),
            *get,
            _event(package, f"{name}_GetResult"),
            Definition(f"{name}_FeedbackMessage", feedback),
        ]
    return []


def _event(package: str, name: str) -> Definition:
    return Definition(
        f"{name}_Event",
        [
            Field("info", Type("service_msgs/ServiceEventInfo")),
            Field("request", Type(f"{package}/{name}_Request", sequence=True, bound=1)),
            Field("response", Type(f"{package}/{name}_Response", sequence=True, bound=1)),
        ],
    )
