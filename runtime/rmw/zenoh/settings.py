"""The settings of a Zenoh session on this machine; all figures are measured.

Multicast and gossip are off: who is there is known from the folder. `open` connects in the background, and a frozen
process holds up nobody: with the library's own values opening, closing and leaving take up to 10 s beside one.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, cast

SCHEME = "unixsock-stream/"

OPEN_TIMEOUT = 600_000
"""How long one attempt to reach another process may take, in ms; nothing waits for it.

Zenoh drops an attempt that takes longer in the middle, and then one side counts a link that carries nothing, until the
watch of the domain finds it: with 0.5 s that were some of twenty processes that started at one moment on a machine with
30 others running. That the other process has ended is seen without a limit: its socket closes.
"""

LEASE = 60_000
"""After how long a link is given up on which nothing has come, in ms; a quarter of it goes by between signs of life.

They are most of what fifty idle processes cost: 13 % of a core with 15 s, 7 % with this. That a process is frozen is
known long before, from its state, and one that ends closes its links.
"""

WAIT_BEFORE_DROP = 50_000
"""How long a publisher waits for a full link before it drops a message, in us.

Plain dropping lost up to 60 % of a burst to healthy readers; blocking stalls the publisher for 5 s beside one that does
not read.
"""

WAIT_BEFORE_CUT = 2_000_000
"""How long a message that must not be dropped waits for a full link before that is closed, in us.

Only the thread that sends those waits. The link to a process that was frozen is made again once it runs.
"""

ROOM_OF_A_LINK = 16
"""How many batches (64 kB each, made when needed) wait in a link for messages of one priority: a burst to a reader that
just has no processor is kept.
"""

NARROW = {"so_sndbuf": 16_384}
"""What a socket to another machine takes before it is sent (bytes; Linux doubles it).

Left to itself it takes 650 kB from a robot that says more than the link carries: over 40 kB/s all was 16 s old, and no
answer came through.
"""
SMALL_BATCH = 8192
"""Bytes that are sent in one piece to another machine, so that an answer need not wait for 64 kB of data before it."""
ROOM_OF_A_NETWORK = 2
"""How many of those wait there for messages of one priority."""

INSEPARABLE = ("connect/retry",)
"""Settings that Zenoh takes only as a whole."""


@dataclass(frozen=True)
class Serving:
    """The way into a mesh for other machines: what a router listens on beside its socket, and its TLS settings."""

    endpoints: tuple[str, ...]
    tls: Mapping[str, Any] = field(default_factory=dict[str, Any])


def network_link(serving: Serving) -> dict[str, Any]:
    """The settings (`transport/link`) of the sockets to other machines, by protocol."""
    return {"tcp": dict(NARROW), "tls": {**NARROW, **serving.tls}}


def session_settings(
    zid: str,
    listen: str,
    connect: Iterable[str],
    serving: Serving | None = None,
    auth: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The settings of a session with this id that listens on one endpoint and connects to others.

    `auth` is what each link must show (`transport/auth`), where the endpoints are not closed by the file system.

    One that lets other machines in is a router, as clients want to find; all others of the mesh are linked directly, so
    that it carries nothing between them.
    """
    beside = serving.endpoints if serving else ()
    room = ROOM_OF_A_NETWORK if serving else ROOM_OF_A_LINK
    return {
        "mode": "router" if serving else "peer",
        "id": zid,
        "routing": {"router": {"peers_failover_brokering": False}},
        "listen": {"endpoints": [listen, *beside], "exit_on_failure": True},
        "connect": {
            "endpoints": list(connect),
            "timeout_ms": -1,
            "exit_on_failure": False,
            "retry": {"period_init_ms": 100, "period_max_ms": 2000, "period_increase_factor": 2},
        },
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "open": {"return_conditions": {"connect_scouted": False, "declares": False}},
        "timestamping": {"enabled": True},
        "transport": {
            "shared_memory": {"enabled": False},
            "auth": dict(auth or {}),
            "unicast": {"open_timeout": OPEN_TIMEOUT, "accept_timeout": OPEN_TIMEOUT},
            "link": {
                **(network_link(serving) if serving else {}),
                "tx": {
                    # Other machines keep the library's lease.
                    **({"batch_size": SMALL_BATCH} if serving else {"lease": LEASE}),
                    "queue": {
                        "size": {"data": room, "data_low": room},
                        "congestion_control": {
                            "drop": {"wait_before_drop": WAIT_BEFORE_DROP},
                            "block": {"wait_before_close": WAIT_BEFORE_CUT},
                        },
                    },
                },
            },
        },
    }


def leaves(settings: Mapping[str, Any], above: str = "") -> Iterable[tuple[str, str]]:
    """The single settings, as path and JSON."""
    for name, value in settings.items():
        if isinstance(value, Mapping) and above + name not in INSEPARABLE:
            yield from leaves(cast("Mapping[str, Any]", value), f"{above}{name}/")
        else:
            yield above + name, json.dumps(value)
