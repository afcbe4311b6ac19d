"""Waits until the subscriptions of played topics have been discovered: messages published before that are lost."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

MIN_S = 0.5
"""Seconds that a newly created node gets to discover the other nodes."""
TIMEOUT_S = 2.0
"""Seconds after which a subscription that is known but not connected, for example because of its QoS, is ignored."""
POLL_S = 0.05


def await_subscriptions(
    publishers: Iterable[Any], subscriptions: Callable[[str], int], stopped: threading.Event
) -> None:
    """Wait until the publishers are connected to all known subscriptions of their topics, or until `stopped` is set.

    `subscriptions` returns the number of subscriptions of a topic in the graph.
    """
    waited = 0.0
    while waited < TIMEOUT_S and not stopped.wait(POLL_S):
        waited += POLL_S
        if waited >= MIN_S and all(
            each.get_subscription_count() >= subscriptions(each.topic_name) for each in publishers
        ):
            return
