"""A session over the network: a client of a robot's Zenoh router, which neither listens nor scouts."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from bot_console.runtime.rmw.qos_matching import RMW_ZENOH, QosRules
from bot_console.runtime.rmw.zenoh.congestion_control import history_rules
from bot_console.runtime.rmw.zenoh.link_probe import LinkProbe, LinkState
from bot_console.runtime.rmw.zenoh.network.frozen_processes import StoppedBehindRouter
from bot_console.runtime.rmw.zenoh.network.reachability import Tls, why_unreachable
from bot_console.runtime.rmw.zenoh.session import ROLL_CALL_KEY, Session, SessionError, SettingsError, endpoints_of_file

CONFIG_VARIABLE = "ZENOH_SESSION_CONFIG_URI"
"""Environment variable that names the session's configuration file, as in rmw_zenoh."""
OVERRIDE_VARIABLE = "ZENOH_CONFIG_OVERRIDE"
"""Environment variable that overrides single settings, as in rmw_zenoh: `path=json5;path=json5`."""
UNANSWERED = (
    "{}: the port is open, but no router answered within {:g} s: try again if the link is slow; otherwise restart the "
    "router, or check the port: something else may listen there"
)
QUERY_TIMEOUT_MS = 600_000
"""Timeout of a query, in ms, unless the caller sets another."""


@dataclass(frozen=True)
class ClientConfig:
    """How to reach a robot: its router's endpoints, such as `tcp/robot:7447`, and the TLS files."""

    endpoints: tuple[str, ...] = ()
    tls: Tls = Tls()  # noqa: RUF009 - it is frozen
    file: str = ""
    """A Zenoh configuration file; the other fields override it."""
    override: tuple[tuple[str, str], ...] = ()
    """Settings (path, JSON5) that override everything else."""
    timeout_s: float = 5.0
    """Timeout of the first connection, in seconds; reconnecting is retried indefinitely."""

    def __str__(self) -> str:
        return ", ".join(self.endpoints) or self.file


def with_environment(config: ClientConfig) -> ClientConfig:
    """Return `config` with the values of rmw_zenoh's environment variables; raises `SessionError` if one is invalid."""
    file, override = os.environ.get(CONFIG_VARIABLE, ""), os.environ.get(OVERRIDE_VARIABLE, "")
    if file and not os.path.isfile(file):
        raise SessionError(f"there is no file {file}, which {CONFIG_VARIABLE} names")
    pairs: list[tuple[str, str]] = []
    for each in filter(None, (part.strip() for part in override.split(";"))):
        path, sign, value = each.partition("=")
        if not (path.strip() and sign and value.strip()):
            raise SessionError(f"{OVERRIDE_VARIABLE} is to be `path=value;path=value`, not {each!r}")
        pairs.append((path.strip(), value.strip()))
    return replace(config, file=file, override=tuple(pairs))


def endpoints_of(config: ClientConfig) -> Sequence[str]:
    """Return the endpoints that a client connects to, whether given in `config` or in its configuration file."""
    return config.endpoints or (endpoints_of_file(config.file, config.override) if config.file else ())


def client_settings(zid: str, config: ClientConfig) -> dict[str, object]:
    """Return a client's settings. It drops at once what a full link cannot take: nothing waits for the network."""
    connect: dict[str, object] = {
        "timeout_ms": round(config.timeout_s * 1000),
        "exit_on_failure": True,
        "retry": {"period_init_ms": 250, "period_max_ms": 1000, "period_increase_factor": 2},
    }
    if config.endpoints:
        connect["endpoints"] = list(config.endpoints)
    return {
        "mode": "client",
        "id": zid,
        "connect": connect,
        "listen": {"endpoints": []},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "timestamping": {"enabled": True},
        "qos": history_rules(),
        "queries_default_timeout": QUERY_TIMEOUT_MS,
        "transport": {"shared_memory": {"enabled": False}, "link": {"tls": config.tls.as_client()}},
    }


class NetworkSession(Session):
    """A client of a router; it reconnects by itself when the router or the link comes back."""

    def __init__(self, domain: int, config: ClientConfig) -> None:
        super().__init__(domain)
        self.config = config
        try:
            self._open(client_settings(self.zid, config), config.file, config.override)
        except SettingsError:
            raise
        except SessionError as error:
            reason = UNANSWERED.format(config, config.timeout_s) if str(error).endswith("Timeout!") else str(error)
            raise SessionError(why_unreachable(config.endpoints, config.tls) or reason) from None
        self.declare_token(ROLL_CALL_KEY + self.zid[:8])
        self._probe: LinkProbe | None = None
        self._stopped: StoppedBehindRouter | None = None

    def qos_rules(self, zid: str) -> QosRules:
        """Return rmw_zenoh's rules, which apply between all nodes that meet at its routers."""
        return RMW_ZENOH

    def watch(self) -> None:
        """Probe the link to the router repeatedly, and track which processes it reports as frozen or in a debugger."""
        self._probe = self._probe or LinkProbe(self.ping, str(self.config))
        self._stopped = self._stopped or StoppedBehindRouter(self)

    def stopped(self) -> Mapping[str, int]:
        """Return the frozen processes behind the router, if it is one of ours; empty unless `watch` was called."""
        return self._stopped.now() if self._stopped else {}

    def debugged(self) -> Mapping[str, str]:
        """Return the processes behind the router that are stopped in a debugger, each with the line."""
        return self._stopped.debugged() if self._stopped else {}

    def stopped_behind_router(self) -> Sequence[int]:
        """Return the pids of the frozen processes, which run on the robot."""
        return sorted(self.stopped().values())

    @property
    def link(self) -> LinkState:
        """The state of the link; unknown unless `watch` was called."""
        state = self._probe.state if self._probe else LinkState(str(self.config))
        return replace(state, lost=self.lost)

    def close(self) -> None:
        """Disconnect; does nothing if already disconnected."""
        if self._probe:
            self._probe.end()
        super().close()


def open_network_session(domain: int, config: ClientConfig) -> NetworkSession:
    """Connect to a robot's router; raises `SessionError`, whose message says why that failed and how to fix it."""
    return NetworkSession(domain, config)
