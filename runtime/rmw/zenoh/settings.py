"""The settings of a Zenoh session on this machine; all figures are measured.

Multicast and gossip are off: who is there is known from the folder. `open` connects in the background, and a frozen
process holds up nobody: with the library's own values opening, closing and leaving take up to 10 s beside one.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

SCHEME = "unixsock-stream/"

OPEN_TIMEOUT = 500
"""How long one attempt to reach another process may take, in ms."""

WAIT_BEFORE_DROP = 50_000
"""How long a publisher waits for a full link before it drops a message, in us.

Plain dropping lost up to 60 % of a burst to healthy readers; blocking stalls the publisher for 5 s beside one that does
not read.
"""


def session_settings(zid: str, listen: str, connect: Iterable[str]) -> dict[str, Any]:
    """The settings of a session with this id that listens on one socket and connects to others (paths)."""
    return {
        "mode": "peer",
        "id": zid,
        "listen": {"endpoints": [SCHEME + listen], "exit_on_failure": True},
        "connect": {
            "endpoints": [SCHEME + each for each in connect],
            "timeout_ms": -1,
            "exit_on_failure": False,
            "retry": {"period_init_ms": 100, "period_max_ms": 2000, "period_increase_factor": 2},
        },
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "open": {"return_conditions": {"connect_scouted": False, "declares": False}},
        "timestamping": {"enabled": True},
        "transport": {
            "shared_memory": {"enabled": False},
            "unicast": {"open_timeout": OPEN_TIMEOUT, "accept_timeout": OPEN_TIMEOUT},
            "link": {"tx": {"queue": {"congestion_control": {"drop": {"wait_before_drop": WAIT_BEFORE_DROP}}}}},
        },
    }
