"""Which middleware the contexts of this process use: the in-process bus, unless the program chose another."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.qos_matching import DDS, QosRules

BusOf = Callable[[int], Bus]
"""Returns the bus of a ROS domain, the same one for every call."""

_bus_of: BusOf = local_bus
_rules: QosRules = DDS


def choose_middleware(bus_of: BusOf, rules: QosRules = DDS) -> None:
    """Make contexts that are initialised from now on use another middleware; only for a program's composition root."""
    global _bus_of, _rules
    _bus_of, _rules = bus_of, rules


def chosen_middleware() -> tuple[BusOf, QosRules]:
    """Return the arguments of the last `choose_middleware`."""
    return _bus_of, _rules


def qos_rules() -> QosRules:
    """Return the QoS rules of the chosen middleware."""
    return _rules


def is_chosen(bus_of: BusOf) -> bool:
    """Whether this is the chosen middleware."""
    return _bus_of is bus_of


def bus_of(domain: int) -> Bus:
    """Return the bus of a ROS domain from the chosen middleware."""
    return _bus_of(domain)
