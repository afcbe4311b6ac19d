"""QoS as the middleware sees it: a protocol that `rclpy.qos.QoSProfile` and received profiles implement."""

from __future__ import annotations

from typing import Protocol


class Policy(Protocol):
    """One policy of a profile, named as in rmw."""

    @property
    def name(self) -> str:
        """The policy's name, such as `RELIABLE`."""
        ...


class Period(Protocol):
    """A duration; zero and the largest values mean no limit (`qos_matching.INFINITE`)."""

    @property
    def nanoseconds(self) -> int:
        """Its length in ns."""
        ...


class Profile(Protocol):
    """A QoS profile, with the attributes of `rclpy.qos.QoSProfile`."""

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
        """Whether lost messages are resent."""
        ...

    @property
    def durability(self) -> Policy:
        """Whether late subscriptions get earlier messages."""
        ...

    @property
    def deadline(self) -> Period:
        """The longest expected time between two messages."""
        ...

    @property
    def lifespan(self) -> Period:
        """How long a message stays valid for delivery."""
        ...

    @property
    def liveliness(self) -> Policy:
        """How a publisher shows that it is alive."""
        ...

    @property
    def liveliness_lease_duration(self) -> Period:
        """How long after its last assertion a publisher counts as dead."""
        ...
