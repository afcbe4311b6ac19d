"""Priorities on a link: what is sent first, what waits, and what is dropped when a link is full or slow.

All figures are measured.
"""

from __future__ import annotations

from bot_console.runtime.rmw.endpoints import Profile, depth

REQUEST_PRIORITY = "INTERACTIVE_HIGH"
"""Zenoh's name for the priority of requests: they overtake messages."""
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


def queue_settings(room: int) -> dict[str, object]:
    """Return Zenoh's settings (`transport/link/tx/queue`) for a link that queues `room` batches per priority."""
    return {
        "size": {"control": ROOM_FOR_DECLARATIONS, "data": room, "data_low": room},
        "congestion_control": {
            "drop": {"wait_before_drop": WAIT_BEFORE_DROP_US},
            "block": {"wait_before_close": WAIT_BEFORE_CUT_US},
        },
    }
