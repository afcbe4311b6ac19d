"""Priorities on a link: what is sent first, what waits, and what is dropped when a link is full or slow.

All figures are measured.
"""

from __future__ import annotations

from bot_console.runtime.rmw.endpoints import Profile, depth

REQUEST_PRIORITY = "INTERACTIVE_HIGH"
"""Zenoh's name for the priority of requests: they overtake messages."""
HISTORY_PRIORITY = "INTERACTIVE_LOW"
"""The priority of messages that a publisher has kept for late subscriptions on other machines, such as a map. Otherwise
they would wait behind everything that is published, which is more than a narrow link carries.
"""
LOG_PRIORITY = "DATA_HIGH"
"""The priority of log lines sent to another machine."""
MESSAGE_PRIORITY = "DATA"
"""The priority of messages that are dropped when a link stays full."""
BLOCKING_PRIORITY = "DATA_LOW"
"""The lower priority of messages that must not be dropped: otherwise publishers that drop would wait behind them."""

WAIT_BEFORE_DROP_US = 50_000
"""How long a publisher waits for a full link before it drops a message, in us.

Dropping at once lost up to 60 % of a burst to healthy readers; blocking stalls the publisher for 5 s next to a reader
that does not read.
"""

WAIT_BEFORE_CUT_US = 2_000_000
"""How long a message that must not be dropped waits for a full link before that link is closed, in us.

Only the thread that sends those messages waits. The link to a process that was frozen is made again once it runs.
"""
WAIT_BEFORE_NETWORK_CUT_US = 10_000_000
"""The same for a link to another machine: as long as Zenoh keeps a link on which nothing arrives.

With 2 s, a kept message that a narrow link carries in more time, such as a map, cut the link again after each
reconnection.
"""

ROOM_OF_A_LINK = 16
"""How many batches (64 kB each, allocated when needed) a link queues for messages of one priority: enough to keep a
burst for a reader that briefly gets no processor time.
"""

ROOM_FOR_DECLARATIONS = 16
"""The same limit for declarations, all of which a new link carries first: enough for 200 nodes."""

NARROW = {"so_sndbuf": 16_384}
"""Socket option that limits the send buffer to another machine (bytes; Linux doubles it).

By default the buffer takes 650 kB from a robot that publishes more than the link carries: at 40 kB/s all messages were
16 s old, and no answer got through.
"""
SMALL_BATCH = 8192
"""Batch size to another machine in bytes, small so that an answer need not wait behind 64 kB of data."""
ROOM_OF_A_NETWORK = 2
"""How many batches of that size a link to another machine queues for messages of one priority."""
ROOM_FOR_HISTORY = 16
"""How many of them it queues for kept messages, the most that Zenoh allows: a map of 128 kB waits in the queue, and the
thread that forwards it goes on with other messages.
"""

DEEP_QUEUE = 1000
"""Depth from which a reliable publisher is treated like one with KEEP_ALL: ROS 2 would keep that many messages for a
reader that is late, whereas a link has room for 1 MB.
"""

BLOCKING_TOPICS = frozenset({"/rosout"})
"""Reliable topics on which nothing is dropped whatever the depth: readers of a log need every line."""


def must_not_drop(topic: str, qos: Profile) -> bool:
    """Whether messages of a publisher wait for a full link, up to `WAIT_BEFORE_CUT_US`, instead of being dropped."""
    keeps_all = (depth(qos) or DEEP_QUEUE) >= DEEP_QUEUE or topic in BLOCKING_TOPICS
    return keeps_all and qos.reliability.name != "BEST_EFFORT"


def queue_settings() -> dict[str, object]:
    """Return Zenoh's settings (`transport/link/tx/queue`) for the links between the processes of this machine."""
    return {
        "size": {"control": ROOM_FOR_DECLARATIONS, "data": ROOM_OF_A_LINK, "data_low": ROOM_OF_A_LINK},
        "congestion_control": congestion_settings(WAIT_BEFORE_CUT_US),
    }


def network_queue_settings() -> dict[str, object]:
    """Return the same settings for links to other machines."""
    return {
        "size": {
            "control": ROOM_FOR_DECLARATIONS,
            "interactive_low": ROOM_FOR_HISTORY,
            "data": ROOM_OF_A_NETWORK,
            "data_low": ROOM_OF_A_NETWORK,
        },
        "congestion_control": congestion_settings(WAIT_BEFORE_NETWORK_CUT_US),
    }


def congestion_settings(wait_before_cut_us: int) -> dict[str, object]:
    """Return Zenoh's settings for how long messages wait for a full link."""
    return {
        "drop": {"wait_before_drop": WAIT_BEFORE_DROP_US},
        "block": {"wait_before_close": wait_before_cut_us},
    }


def forwarding_rules() -> dict[str, object]:
    """Return a router's settings (`qos`) for the messages it forwards: none of them waits for a full link, log lines
    overtake other messages, and the states of the emergency stop overtake both.

    A message that waited would hold up the thread that forwards everything else from the same process, and finally cut
    the link.
    """
    forwarded = {"messages": ["put"], "flows": ["egress"]}
    rules = (
        {
            "qos": {"congestion_control": "block"},
            "overwrite": {"congestion_control": "drop", "priority": MESSAGE_PRIORITY.lower()},
        },
        {"key_exprs": ["*/rosout/**"], "overwrite": {"priority": LOG_PRIORITY.lower()}},
        {"key_exprs": ["*/emergency_stop/**"], "overwrite": {"priority": REQUEST_PRIORITY.lower()}},
    )
    return {"network": [{**forwarded, **rule} for rule in rules]}


def history_rules() -> dict[str, object]:
    """Return a client's settings (`qos`) for its queries of kept messages: the replies get the query's priority."""
    rule = {
        "messages": ["query"],
        "flows": ["egress"],
        "qos": {"priority": MESSAGE_PRIORITY.lower()},
        "overwrite": {"priority": HISTORY_PRIORITY.lower()},
    }
    return {"network": [rule]}
