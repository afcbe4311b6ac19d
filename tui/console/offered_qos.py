"""A subscription that adapts its QoS to its publishers.

A subscription that requests more than they offer receives nothing, and makes them warn; one that requests less loses
messages. The offered QoS changes as nodes come and go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy


class OfferedSubscription:
    """Subscribes to one topic; `follow` has to be called whenever the graph has changed."""

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
        """`best` is the most that is requested, provided that it is offered.

        An `eager` subscription exists before anybody publishes. With `once_weak`, a subscription that had to request
        less stays that way, because requesting more again would deliver the messages of latching publishers a second
        time. A `raw` subscription passes serialized bytes to the callback.
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
        """Adapt to the QoS that is offered now; while nothing is offered, change nothing."""
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
        """The waiting serialized messages, each with the time at which it was sent (ns since the epoch; 0: unknown).

        For nodes that are not spun; this costs a third of an executor's callbacks.
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
    """The strongest QoS, up to `best`, that all `offers` meet; a policy unknown to the graph counts as the weakest."""
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
    """The strongest QoS that exceeds neither of the two."""
    both = (one, other)
    return (
        ReliabilityPolicy.BEST_EFFORT if any(each[0] != ReliabilityPolicy.RELIABLE for each in both) else one[0],
        DurabilityPolicy.VOLATILE if any(each[1] != DurabilityPolicy.TRANSIENT_LOCAL for each in both) else one[1],
    )
