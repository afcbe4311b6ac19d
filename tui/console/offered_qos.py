"""A subscription with the QoS its publishers offer: one that requests more receives nothing, and makes them warn.

One that requests less than is offered loses messages it could have had, so neither is fixed; the offer changes as nodes
come and go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy


class OfferedSubscription:
    """Subscribes to one topic; `follow` is to be called whenever the graph has changed."""

    def __init__(
        self,
        node: Node,
        kind: Any,
        topic: str,
        callback: Callable[[Any], None],
        best: QoSProfile,
        *,
        eager: bool = True,
        once_weak: bool = False,
        raw: bool = False,
    ) -> None:
        """`best` is the most that is requested, if it is offered.

        An `eager` subscription exists before anybody publishes. With `once_weak`, one that had to request less stays
        that way: requesting more again would deliver a second time what latching publishers keep. A `raw` one calls
        back with the serialized bytes.
        """
        self._raw = raw
        self._node = node
        self._kind = kind
        self.topic_name = topic
        self._callback = callback
        self._best = best
        self._once_weak = once_weak
        self._asked: tuple[ReliabilityPolicy, DurabilityPolicy] | None = None
        self._subscription: Any = None
        if eager:
            self._subscribe((best.reliability, best.durability))
        else:
            self.follow()

    def follow(self) -> None:
        """Request what is offered now; while nothing is offered, leave everything as it is."""
        infos = self._node.get_publishers_info_by_topic(self.topic_name)
        if not infos:
            return
        asked = weakest(self._best, (each.qos_profile for each in infos))
        if self._once_weak and self._asked is not None:
            asked = weaker(self._asked, asked)
        if asked != self._asked:
            self._subscribe(asked)

    def _subscribe(self, asked: tuple[ReliabilityPolicy, DurabilityPolicy]) -> None:
        before, best = self._subscription, self._best
        profile = QoSProfile(history=best.history, depth=best.depth, reliability=asked[0], durability=asked[1])
        self._subscription = self._node.create_subscription(
            self._kind, self.topic_name, self._callback, profile, raw=self._raw
        )
        self._asked = asked
        if before is not None:
            self._node.destroy_subscription(before)

    def drain(self) -> Iterator[tuple[bytes, int]]:
        """The waiting serialized messages, with the time at which each was sent (ns since the epoch; 0: unknown).

        For nodes that are not spun: this costs a third of what an executor's callbacks do.
        """
        if self._subscription is None:
            return
        handle = self._subscription.handle
        with handle:
            while (taken := handle.take_message(self._kind, True)) is not None:
                yield bytes(taken[0]), taken[1]["source_timestamp"] or 0

    def destroy(self) -> None:
        """End the subscription."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None


def weakest(best: QoSProfile, offers: Iterable[Any]) -> tuple[ReliabilityPolicy, DurabilityPolicy]:
    """The strongest QoS, up to `best`, that all of these offer; a policy unknown to the graph counts as the weakest."""
    offers = list(offers)
    reliable = all(each.reliability == ReliabilityPolicy.RELIABLE for each in offers)
    latched = all(each.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in offers)
    offered = (
        ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
    return weaker(offered, (best.reliability, best.durability))


def weaker(
    one: tuple[ReliabilityPolicy, DurabilityPolicy], other: tuple[ReliabilityPolicy, DurabilityPolicy]
) -> tuple[ReliabilityPolicy, DurabilityPolicy]:
    """The strongest QoS that satisfies both."""
    both = (one, other)
    return (
        ReliabilityPolicy.BEST_EFFORT if any(each[0] != ReliabilityPolicy.RELIABLE for each in both) else one[0],
        DurabilityPolicy.VOLATILE if any(each[1] != DurabilityPolicy.TRANSIENT_LOCAL for each in both) else one[1],
    )
