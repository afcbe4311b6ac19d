"""QoS as the middleware sees it: a protocol met by `rclpy.qos.QoSProfile` and by profiles received from elsewhere."""

from __future__ import annotations

from typing import Protocol


class Policy(Protocol):
    """One policy of a profile; its names are rmw's."""

    @property
    def name(self) -> str:
        """Such as `RELIABLE`."""
        ...


class Period(Protocol):
    """A duration; zero and the largest ones mean no limit."""

    @property
    def nanoseconds(self) -> int:
        """Its length."""
        ...


class Profile(Protocol):
    """A quality of service, as `rclpy.qos.QoSProfile` has it."""

    @property
    def history(self) -> Policy:
        """Which messages are kept."""
        ...

    @property
    def depth(self) -> int:
        """How many messages are kept with KEEP_LAST."""
        ...

    @property
    def reliability(self) -> Policy:
        """Whether lost messages are sent again."""
        ...

    @property
    def durability(self) -> Policy:
        """Whether late subscriptions get what came before."""
        ...

    @property
    def deadline(self) -> Period:
        """The longest time that is expected between two messages."""
        ...

    @property
    def lifespan(self) -> Period:
        """How long a message is worth delivering."""
        ...

    @property
    def liveliness(self) -> Policy:
        """How a publisher shows that it is alive."""
        ...

    @property
    def liveliness_lease_duration(self) -> Period:
        """After what silence a publisher counts as dead."""
        ...
