"""A Zenoh router of our own, for tests and for robots that have none."""

from __future__ import annotations

from bot_console.runtime.rmw.zenoh.congestion_control import SMALL_BATCH, forwarding_rules, network_queue_settings
from bot_console.runtime.rmw.zenoh.session import Session, SessionError, SettingsError
from bot_console.runtime.rmw.zenoh.settings import Serving, network_link


def router_settings(zid: str, serving: Serving) -> dict[str, object]:
    """Return a router's settings as rmw_zenoh expects: nodes discover each other through it, then link directly."""
    return {
        "mode": "router",
        "id": zid,
        "listen": {"endpoints": list(serving.endpoints), "exit_on_failure": True},
        "connect": {"endpoints": []},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": True}},
        "timestamping": {"enabled": True},
        "qos": forwarding_rules(),
        "transport": {
            "shared_memory": {"enabled": False},
            "link": {
                **network_link(serving),
                "tx": {"batch_size": SMALL_BATCH, "queue": network_queue_settings()},
            },
        },
    }


class Router(Session):
    """A session that routes the traffic of others until it is closed. It belongs to no domain."""

    def __init__(self, serving: Serving, file: str = "") -> None:
        """`file` is a Zenoh configuration, for instance with an access list. Raises `SessionError`."""
        super().__init__(0)
        try:
            self._open(router_settings(self.zid, serving), file)
        except SettingsError:
            raise
        except SessionError as error:
            raise SessionError(f"cannot listen on {', '.join(serving.endpoints)}: {error}") from None
