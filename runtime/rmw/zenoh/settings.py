"""The settings of a Zenoh session on this machine; all figures are measured.

Multicast is off, as the folder lists the processes. `open` connects in the background, so that a frozen process blocks
nobody: with Zenoh's defaults, opening, closing and leaving take up to 10 s beside one.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, cast

from bot_console.runtime.rmw.zenoh.congestion_control import (
    NARROW,
    SMALL_BATCH,
    forwarding_rules,
    network_queue_settings,
    queue_settings,
)

SCHEME = "unixsock-stream/"

OPEN_TIMEOUT_MS = 600_000
"""Timeout of one attempt to connect to another process, in ms; nothing waits for it.

Zenoh aborts a longer attempt half-way, and then one side keeps a link that carries nothing until the domain's watch
finds it: with 0.5 s this happened to some of twenty processes started at once on a machine with 30 others running. The
end of the other process is noticed regardless of this limit, as its socket closes.
"""

LEASE_MS = 60_000
"""Silence after which a link is given up, in ms; keep-alives are sent four times as often.

Keep-alives are most of what fifty idle processes cost: 13 % of a core with 15 s, 7 % with this value. A frozen process
is detected much earlier, by its state, and a process that ends closes its links.
"""

MESH_REGION = "bot_console"
"""Name of the Zenoh region of a domain's processes, which link to each other."""
ADMITTED_REGIONS = (
    {"filters": [{"region_names": [MESH_REGION]}]},
    {"filters": [{"modes": ["peer", "client"]}]},
)
"""The regions between which a router of the mesh forwards; a session belongs to the first one that it matches.

Zenoh forwards nothing between the peers of one region, and a node of rmw_zenoh is a peer by default.
"""

INSEPARABLE = ("connect/retry",)
"""Settings that Zenoh accepts only as a whole."""


class Serving(NamedTuple):
    """A mesh's access for other machines: the endpoints a router listens on besides its socket, and TLS settings."""

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

    `auth` holds the credentials that each link must present (`transport/auth`) if the file system does not protect the
    endpoints.

    A session that admits other machines is a router, as rmw_zenoh's nodes and clients expect. It forwards between them
    and the mesh, and announces peers to each other by gossip; the mesh's own processes are linked directly.
    """
    beside = serving.endpoints if serving else ()
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
        **({"qos": forwarding_rules()} if serving else {}),
        "transport": {
            "shared_memory": {"enabled": False},
            "auth": dict(auth or {}),
            "unicast": {"open_timeout": OPEN_TIMEOUT_MS, "accept_timeout": OPEN_TIMEOUT_MS},
            "link": {
                **(network_link(serving) if serving else {}),
                "tx": {
                    # Links to other machines have Zenoh's default lease.
                    **({"batch_size": SMALL_BATCH} if serving else {"lease": LEASE_MS}),
                    "queue": network_queue_settings() if serving else queue_settings(),
                },
            },
        },
    }


def leaf_settings(settings: Mapping[str, object], above: str = "") -> Iterable[tuple[str, str]]:
    """Yield the settings one by one, as path and JSON."""
    for name, value in settings.items():
        if isinstance(value, Mapping) and above + name not in INSEPARABLE:
            yield from leaf_settings(cast("Mapping[str, Any]", value), f"{above}{name}/")
        else:
            yield above + name, json.dumps(value)
