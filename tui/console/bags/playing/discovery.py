"""Waits until the subscriptions to what is played have been found: what is published before is lost."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

MIN_S = 0.5
"""How long others get to be discovered by a node that has just been made."""
TIMEOUT_S = 2.0
"""After this time, a subscription that is known but not connected, such as one with another QoS, is not waited for."""
POLL_S = 0.05


def await_subscriptions(
    publishers: Iterable[Any], subscriptions: Callable[[str], int], stopped: threading.Event
) -> None:
    """Wait until the publishers are connected to all known subscriptions of their topics, or until `stopped` is set.

    `subscriptions` counts those of a topic in the graph.
    """
    waited = 0.0
    while waited < TIMEOUT_S and not stopped.wait(POLL_S):
        waited += POLL_S
        if waited >= MIN_S and all(
            each.get_subscription_count() >= subscriptions(each.topic_name) for each in publishers
        ):
            return
