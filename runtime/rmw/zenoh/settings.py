"""The settings of a Zenoh session on this machine; all figures are measured.

Multicast is off: the folder lists the processes. `open` connects in the background, and a frozen process blocks nobody:
with Zenoh's defaults opening, closing and leaving take up to 10 s next to one.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, cast

SCHEME = "unixsock-stream/"

OPEN_TIMEOUT = 600_000
"""Timeout of one attempt to connect to another process, in ms; nothing waits for it.

Zenoh aborts a longer attempt half-way, and then one side counts a link that carries nothing, until the domain's watch
finds it: with 0.5 s this happened to some of twenty processes started at once on a machine with 30 others running. That
the other process has ended is noticed regardless of this limit: its socket closes.
"""

LEASE = 60_000
"""Silence after which a link is given up, in ms; a quarter of it passes between keep-alives.

Keep-alives are most of what fifty idle processes cost: 13 % of a core with 15 s, 7 % with this value. A frozen process
is detected much earlier, by its state, and a process that ends closes its links.
"""

WAIT_BEFORE_DROP = 50_000
"""How long a publisher waits for a full link before it drops a message, in us.

Dropping at once lost up to 60 % of a burst to healthy readers; blocking stalls the publisher for 5 s next to a reader
that does not read.
"""

WAIT_BEFORE_CUT = 2_000_000
"""How long a message that must not be dropped waits for a full link before that link is closed, in us.

Only the thread that sends those messages waits. The link to a process that was frozen is made again once it runs.
"""

ROOM_OF_A_LINK = 16
"""How many batches (64 kB each, allocated when needed) a link queues for messages of one priority: a burst to a reader
that is briefly without a processor is kept.
"""

NARROW = {"so_sndbuf": 16_384}
"""Send buffer of a socket to another machine (bytes; Linux doubles it).

By default it takes 650 kB from a robot that publishes more than the link carries: at 40 kB/s all messages were 16 s
old, and no answer came through.
"""
SMALL_BATCH = 8192
"""Batch size to another machine in bytes, small so that an answer need not wait behind 64 kB of data."""
ROOM_OF_A_NETWORK = 2
"""How many of those batches a link queues for messages of one priority."""

MESH_REGION = "bot_console"
"""Name of the Zenoh region of a domain's processes, which link to each other."""
ADMITTED_REGIONS = (
    {"filters": [{"region_names": [MESH_REGION]}]},
    {"filters": [{"modes": ["peer", "client"]}]},
)
"""The regions between which a router of the mesh forwards; a session belongs to the first that fits.

Zenoh forwards nothing between the peers of one region, and a node of rmw_zenoh is a peer by default.
"""

INSEPARABLE = ("connect/retry",)
"""Settings that Zenoh accepts only as a whole."""


class Serving(NamedTuple):
    """A mesh's entry for other machines: the endpoints a router listens on besides its socket, and its TLS settings."""

    endpoints: tuple[str, ...]
    tls: Mapping[str, object] = MappingProxyType({})


def network_link(serving: Serving) -> dict[str, object]:
    """Return the `transport/link` settings of the sockets to other machines, by protocol."""
    return {"tcp": dict(NARROW), "tls": {**NARROW, **serving.tls}}


def session_settings(
    zid: str,
    listen: str,
    connect: Iterable[str],
    serving: Serving | None = None,
    auth: Mapping[str, object] | None = None,
) -> dict[str, object]:
    """Return the settings of a session with this id that listens on one endpoint and connects to others.

    `auth` holds the credentials each link must present (`transport/auth`), if the file system does not protect the
    endpoints.

    A session that admits other machines is a router, as nodes of rmw_zenoh and clients expect. It forwards between them
    and the mesh, and tells peers of each other by gossip; the mesh's own processes are linked directly.
    """
    beside = serving.endpoints if serving else ()
    room = ROOM_OF_A_NETWORK if serving else ROOM_OF_A_LINK
    return {
        "id": zid,
        **(
            {"mode": "router", "gateway": {"south": list(ADMITTED_REGIONS)}}
            if serving
            else {"mode": "peer", "region_name": MESH_REGION}
        ),
        "listen": {"endpoints": [listen, *beside], "exit_on_failure": True},
        "connect": {
            "endpoints": list(connect),
            "timeout_ms": -1,
            "exit_on_failure": False,
            "retry": {"period_init_ms": 100, "period_max_ms": 2000, "period_increase_factor": 2},
        },
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": bool(serving)}},
        "open": {"return_conditions": {"connect_scouted": False, "declares": False}},
        "timestamping": {"enabled": True},
        "transport": {
            "shared_memory": {"enabled": False},
            "auth": dict(auth or {}),
            "unicast": {"open_timeout": OPEN_TIMEOUT, "accept_timeout": OPEN_TIMEOUT},
            "link": {
                **(network_link(serving) if serving else {}),
                "tx": {
                    # Links to other machines keep Zenoh's default lease.
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


def leaves(settings: Mapping[str, object], above: str = "") -> Iterable[tuple[str, str]]:
    """Yield the single settings, as path and JSON."""
    for name, value in settings.items():
        if isinstance(value, Mapping) and above + name not in INSEPARABLE:
            yield from leaves(cast("Mapping[str, Any]", value), f"{above}{name}/")
        else:
            yield above + name, json.dumps(value)
