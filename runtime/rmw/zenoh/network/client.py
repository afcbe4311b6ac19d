"""A session on a network: a client of a robot's Zenoh router, which listens nowhere and searches for nobody."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from bot_console.runtime.rmw.zenoh.link_probe import LinkProbe, LinkState
from bot_console.runtime.rmw.zenoh.network.reach import Tls, why_unreachable
from bot_console.runtime.rmw.zenoh.network.stopped import StoppedBehind
from bot_console.runtime.rmw.zenoh.session import ATTENDANCE, Session, SessionError, SettingsError

CONFIG_VARIABLE = "ZENOH_SESSION_CONFIG_URI"
"""Names a session's configuration file, as for nodes of rmw_zenoh."""
OVERRIDE_VARIABLE = "ZENOH_CONFIG_OVERRIDE"
"""Has the last word on single settings, as for nodes of rmw_zenoh: `path=json5;path=json5`."""
QUERY_TIMEOUT = 600_000
"""After this time, in ms, an answer is waited for no more, unless who asks says otherwise."""


@dataclass(frozen=True)
class Way:
    """The way to a robot: the endpoints of its router, such as `tcp/robot:7447`, and the files for TLS."""

    endpoints: tuple[str, ...] = ()
    tls: Tls = Tls()  # noqa: RUF009 - it is frozen
    file: str = ""
    """A configuration of Zenoh; what is given beside it has precedence."""
    override: tuple[tuple[str, str], ...] = ()
    """Settings (path, JSON5) that have the last word."""
    patience: float = 5.0
    """Seconds for the first connection; later ones are tried for ever."""

    def __str__(self) -> str:
        return ", ".join(self.endpoints) or self.file


def with_environment(way: Way) -> Way:
    """The way with what the variables of rmw_zenoh say; raises `SessionError` for what they cannot mean."""
    file, override = os.environ.get(CONFIG_VARIABLE, ""), os.environ.get(OVERRIDE_VARIABLE, "")
    if file and not os.path.isfile(file):
        raise SessionError(f"there is no file {file}, which {CONFIG_VARIABLE} names")
    pairs: list[tuple[str, str]] = []
    for each in filter(None, (part.strip() for part in override.split(";"))):
        path, sign, value = each.partition("=")
        if not (path.strip() and sign and value.strip()):
            raise SessionError(f"{OVERRIDE_VARIABLE} is to be `path=value;path=value`, not {each!r}")
        pairs.append((path.strip(), value.strip()))
    return replace(way, file=file, override=tuple(pairs))


def client_settings(zid: str, way: Way) -> dict[str, Any]:
    """The settings of a client. It drops at once what a full link does not take: nothing here waits for a network."""
    connect: dict[str, Any] = {
        "timeout_ms": round(way.patience * 1000),
        "exit_on_failure": True,
        "retry": {"period_init_ms": 250, "period_max_ms": 1000, "period_increase_factor": 2},
    }
    if way.endpoints:
        connect["endpoints"] = list(way.endpoints)
    return {
        "mode": "client",
        "id": zid,
        "connect": connect,
        "listen": {"endpoints": []},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "timestamping": {"enabled": True},
        "queries_default_timeout": QUERY_TIMEOUT,
        "transport": {"shared_memory": {"enabled": False}, "link": {"tls": way.tls.as_client()}},
    }


class NetworkSession(Session):
    """A client of a router; it connects again by itself when the router or the link comes back."""

    patience = 3.0

    def __init__(self, domain: int, way: Way) -> None:
        super().__init__(domain)
        self.way = way
        try:
            self._open(client_settings(self.zid, way), way.file, way.override)
        except SettingsError:
            raise
        except SessionError as error:
            raise SessionError(why_unreachable(way.endpoints, way.tls) or str(error)) from None
        self.declare_token(ATTENDANCE + self.zid[:8])
        self._probe: LinkProbe | None = None
        self._stopped: StoppedBehind | None = None

    def watch(self) -> None:
        """Ask the router again and again whether the link is alive, and look which processes it shows as frozen."""
        self._probe = self._probe or LinkProbe(self.question, str(self.way))
        self._stopped = self._stopped or StoppedBehind(self)

    def stopped(self) -> Mapping[str, int]:
        """The frozen processes behind the router, where it is one of ours; nothing is known while nobody watches."""
        return self._stopped.now() if self._stopped else {}

    def stopped_afar(self) -> Sequence[int]:
        """The ids of those processes, which are the robot's."""
        return sorted(self.stopped().values())

    @property
    def link(self) -> LinkState:
        """How the link is; nothing is known while nobody watches."""
        state = self._probe.state if self._probe else LinkState(str(self.way))
        return replace(state, lost=self.lost)

    def close(self) -> None:
        """Hang up; a second time does nothing."""
        if self._probe:
            self._probe.end()
        super().close()


def open_network_session(domain: int, way: Way) -> NetworkSession:
    """Connect to a robot's router; raises `SessionError`, whose text says why not and how to mend it."""
    return NetworkSession(domain, way)
