"""Describes where the machine's ROS 2 looks for other nodes: domain, discovery range and network interfaces."""

from __future__ import annotations

import os
import socket
import struct
import sys
from collections.abc import Callable, Mapping, Sequence

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
LOCALHOST_VARIABLE = "ROS_LOCALHOST_ONLY"
PEERS_VARIABLE = "ROS_STATIC_PEERS"
"""Lists addresses that are searched in addition, separated by semicolons."""
RANGES = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")
"""The discovery ranges of rcl; the first one is the default."""
CONFIGURATION_VARIABLES = (
    "FASTDDS_DEFAULT_PROFILES_FILE",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "CYCLONEDDS_URI",
    "ZENOH_SESSION_CONFIG_URI",
)
"""These name files in which a middleware may choose its own interfaces."""
_ADDRESS_REQUEST = 0x8915
"""`SIOCGIFADDR` of Linux: queries the IPv4 address of an interface."""


def network_use(environ: Mapping[str, str], addresses: Callable[[], Sequence[str]] | None = None) -> str:
    """Describe the network use in one line, such as `domain 0, range SUBNET, interface eth0 (192.168.1.5)`."""
    domain, reach = environ.get("ROS_DOMAIN_ID", "") or "0", discovery_range(environ)
    return f"domain {domain}, range {reach}, {_interfaces(reach, environ, addresses or network_addresses)}"


def discovery_range(environ: Mapping[str, str]) -> str:
    """The range that rcl takes from the environment; like rcl, an unknown one is taken for LOCALHOST."""
    if environ.get(LOCALHOST_VARIABLE) == "1":  # deprecated, but it still takes precedence
        return "LOCALHOST"
    named = environ.get(RANGE_VARIABLE, "") or RANGES[0]
    return named if named in RANGES else "LOCALHOST"


def set_discovery_range(named: str) -> None:
    """Make contexts that are initialised from now on search in this range, whatever the environment said before."""
    os.environ[RANGE_VARIABLE] = named
    os.environ.pop(LOCALHOST_VARIABLE, None)


def _interfaces(reach: str, environ: Mapping[str, str], addresses: Callable[[], Sequence[str]]) -> str:
    if reach == "OFF":
        return "which finds no other node"
    peers = environ.get(PEERS_VARIABLE, "").replace(";", ", ")
    named = f" and peers {peers}" if peers and reach != "SYSTEM_DEFAULT" else ""
    if reach == "LOCALHOST":
        return f"this machine (lo){named}" if named else "this machine only (lo)"
    for variable in CONFIGURATION_VARIABLES:
        if environ.get(variable):
            return f"interfaces as in the file of {variable}"
    found = addresses()
    if not found:
        return "interface lo alone: no other one is up"
    return f"interface{'s' if len(found) > 1 else ''} {', '.join(found)}{named}"


def network_addresses() -> list[str]:
    """The interfaces that have an IPv4 address, with the address; without loopback interfaces."""
    if sys.platform != "linux":
        return ["of all networks"]
    import fcntl

    found: list[str] = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        for _, name in socket.if_nameindex():
            try:
                answer = fcntl.ioctl(asked, _ADDRESS_REQUEST, struct.pack("256s", name.encode()[:15]))
            except OSError:  # the interface has no address
                continue
            address = socket.inet_ntoa(answer[20:24])
            if not address.startswith("127."):
                found.append(f"{name} ({address})")
    return found
