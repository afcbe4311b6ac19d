"""Connects a program to a robot's router, as a client."""

from __future__ import annotations

import atexit
import os
from collections.abc import Sequence

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.middleware import bus_of, choose_middleware
from bot_console.runtime.rmw.qos_matching import RMW_ZENOH
from bot_console.runtime.rmw.zenoh.network.client import OVERRIDE_VARIABLE, ClientConfig, endpoints_of, with_environment
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.runtime.rmw.zenoh.network.reachability import place_of
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.runtime.rmw.zenoh.settings import leaf_settings
from bot_console.tui.session.embedded.domain import CONNECT_VARIABLE, domain, note_connection

ESCAPED_SEMICOLON = "\\u003b"
"""A semicolon in a JSON5 string; a plain one would separate the settings in the variable."""


def connect(config: ClientConfig) -> NetworkBuses:
    """From now on make the contexts of this process clients of a router; raises `SessionError` with the reason."""
    install()
    buses = NetworkBuses(with_environment(config))
    choose_middleware(buses, RMW_ZENOH)
    atexit.register(buses.close)
    bus_of(domain())  # connects now, so that a failure is reported before there is a screen
    note_connection()
    return buses


def lead_children_to(config: ClientConfig) -> None:
    """Make programs that this one starts connect to the same router, through the environment that they inherit."""
    tls = leaf_settings({"transport": {"link": {"tls": config.tls.as_client()}}})
    settings = [f"{path}={value.replace(';', ESCAPED_SEMICOLON)}" for path, value in tls]
    given = os.environ.get(OVERRIDE_VARIABLE, "")
    os.environ[CONNECT_VARIABLE] = " ".join(endpoints_of(with_environment(config)))
    os.environ[OVERRIDE_VARIABLE] = ";".join([*settings, *filter(None, [given])])


def connect_to(endpoints: Sequence[str]) -> str:
    """Connect to these routers; returns why that fails, in one line, or an empty text."""
    try:
        for each in endpoints:
            place_of(each)
        connect(ClientConfig(tuple(endpoints)))
    except (SessionError, ValueError) as error:
        return str(error)
    return ""
