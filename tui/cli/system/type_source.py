"""Interfaces made of what nodes tell of them, for a console whose own types do not suffice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


class DomainTypes:
    """`TypeSource` over the runtime."""

    def service_hashes(self, domain: int, service: str) -> Mapping[str, str]:
        """The hashes of the type of a service, by the nodes of other processes that offer it."""
        from bot_console.runtime.rmw.middleware import bus_of

        servers = [each for tables in bus_of(domain).tables() for each in tables.servers.on(service)]
        return {each.node.full_name: each.type_hash for each in servers if each.type_hash}

    def learn(self, type_name: str, type_hash: str, told: Any) -> str:
        """Take a response of `get_type_description`; why that cannot be, as said of the node, else empty."""
        from bot_console.runtime.learned_interfaces import learn

        return learn(type_name, type_hash, told)
