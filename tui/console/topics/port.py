"""The port for topics, services and actions, as a person inspects and uses them. Standard library only."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from bot_console.tui.console.answer import Answer


class Payload(Enum):
    """The content of a form: a message of a topic, the request of a service, or the goal of an action."""

    MESSAGE = "message"
    REQUEST = "request"
    GOAL = "goal"


@dataclass(frozen=True, slots=True)
class Measure:
    """The measurements of a topic; None where there are none yet, or where its messages do not allow them."""

    rate: float | None = None
    """The rate in Hz over the last seconds; 0 if nothing was received."""
    bandwidth: float | None = None
    """Bytes per second, serialized."""
    age: float | None = None
    """Seconds since the newest message."""
    latency: float | None = None
    """Mean time from the stamp in the header to reception, in seconds."""
    count: int = 0
    problem: str = ""
    """Why the topic cannot be measured; empty if it can."""
    provisional: bool = False
    """Whether too little was measured for the rate and the bandwidth to be reliable."""


MAX_DEPTH = 10_000
"""The maximum depth that a person can request for a subscription."""


@dataclass(frozen=True, slots=True)
class RequestedQos:
    """The QoS that a person requests for a subscription; an empty or zero value means: as the publishers offer it."""

    reliability: str = ""
    """`reliable` or `best_effort`. Like the next two, it has the names that `ros2 topic echo --qos-...` accepts."""
    durability: str = ""
    history: str = ""
    depth: int = 0

    @property
    def text(self) -> str:
        """The requested settings, in the words of the QoS list; empty if nothing is requested."""
        words = [each.replace("_", " ") for each in (self.reliability, self.durability, self.history) if each]
        return " ".join([*words, *([f"depth {self.depth}"] if self.depth else [])])


@dataclass(frozen=True, slots=True)
class Field:
    """A line of a message: a field, or an element of an array."""

    path: str
    name: str
    depth: int
    type: str
    text: str = ""
    """The value on one line; for a field with lines below it, a summary or an empty text."""
    unit: str = ""
    number: bool = False
    """Whether it can be plotted."""
    holds: int = 0
    """The number of following lines that are part of it."""
    closed: bool = False
    """Whether the following lines are collapsed, being of little use to most users."""


@dataclass(frozen=True, slots=True)
class LiveMessage:
    """The newest message of the topic being watched."""

    topic: str = ""
    type: str = ""
    fields: tuple[Field, ...] = ()
    count: int = 0
    """Number of messages received so far."""
    age: float | None = None
    problem: str = ""
    """Why there is no message, or why none can arrive; empty when all is well."""


@dataclass(frozen=True, slots=True)
class Slot:
    """A field of a form: its current text, and the choices for it."""

    path: str
    name: str
    depth: int
    type: str
    text: str = ""
    choices: tuple[str, ...] = ()
    unit: str = ""
    editable: bool = True
    """Whether a value can be typed; if not, the following slots are the parts of the field."""


@dataclass(frozen=True, slots=True)
class Repeated:
    """A message that is published at a rate."""

    type: str
    rate: float
    """The rate in Hz."""
    count: int = 0
    problem: str = ""


@dataclass(frozen=True, slots=True)
class Reply:
    """The response of a service as fields, or why there is none."""

    ok: bool
    text: str = ""
    seconds: float = 0.0
    """Seconds from the request to the response."""
    fields: tuple[Field, ...] = ()


@dataclass(frozen=True, slots=True)
class Goal:
    """The last goal sent to an action from this console."""

    action: str
    status: str
    """A text such as `executing`, `succeeded` or `rejected`."""
    active: bool = True
    seconds: float = 0.0
    """Seconds from the sending of the goal to its end, or to now."""
    feedback: tuple[Field, ...] = ()
    feedback_count: int = 0
    result: tuple[Field, ...] = ()
    problem: str = ""


Values = Mapping[str, str]
"""The values typed into a form, by path; unchanged fields are left out."""


class Topics(Protocol):
    """Inspects and uses the topics, services and actions of a ROS system."""

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """From now on, measure exactly these topics for a requester, with the QoS that their publishers offer."""
        ...

    def measured(self) -> Mapping[str, Measure]:
        """The measurements of all requested topics."""
        ...

    def newest(self) -> Mapping[str, str]:
        """The newest value of each requested topic on one line, except where messages are too large to read."""
        ...

    def expect(self, path: str) -> Answer:
        """Check continuously whether topics have the rates and ages that a file expects; an empty path ends the checks.

        The results are in `ConsoleSnapshot.rate_checks`.
        """
        ...

    def listen(self, topic: str, qos: RequestedQos | None = None) -> None:
        """Keep the newest message of this topic and no other; an empty name ends that.

        Without `qos`, the subscription has the QoS that the publishers offer.
        """
        ...

    def heard(self) -> LiveMessage:
        """The newest message of that topic; the same object until there is another one."""
        ...

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        """The form of a type, with the values typed so far; raises `ValueError` if the type is unknown here."""
        ...

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        """Why a text is not valid in a slot; empty if it is."""
        ...

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        """The `ros2` command line that sends the same message (at `rate`, or once), request or goal."""
        ...

    def earlier(self, name: str) -> Sequence[Values]:
        """The values sent from here to a topic, service or action, newest last."""
        ...

    def publish(self, topic: str, type_name: str, values: Values, rate: float = 0.0) -> Answer:
        """Publish a message once, or at a rate (Hz) until `stop`."""
        ...

    def repeated(self) -> Mapping[str, Repeated]:
        """The messages being published at a rate, by topic; the same object until something changes."""
        ...

    def stop(self, topic: str = "") -> None:
        """Stop publishing to a topic, or to all topics if no name is given."""
        ...

    def call(self, service: str, type_name: str, values: Values) -> Future[Reply]:
        """Call a service."""
        ...

    def call_service(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call a service with the given request fields; the answer is the outcome that the response reports."""
        ...

    def send_goal(self, action: str, type_name: str, values: Values) -> Answer:
        """Send a goal; its progress is in `goals`."""
        ...

    def goals(self) -> Mapping[str, Goal]:
        """The last goal sent from here to each action."""
        ...

    def cancel(self, action: str) -> Answer:
        """Ask the action to cancel its last goal."""
        ...
