"""The names of topics and services on DDS, where a service is a topic for requests and one for replies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from bot_console.runtime.rmw.endpoints import Owner

Pair = tuple[str, str]
TOPIC = "rt"
"""Precedes the name of a topic."""


def written_by(tables: Iterable[Any], owner: Owner) -> Iterator[Pair]:
    """Yield what a node publishes: its topics, the replies of its services, the requests of its clients."""
    for each in tables:
        yield from map(_topic, each.publishers.of(owner))
        yield from map(_reply, each.servers.of(owner))
        yield from map(_request, each.clients.of(owner))


def read_by(tables: Iterable[Any], owner: Owner) -> Iterator[Pair]:
    """Yield what a node subscribes to: its topics, the requests of its services, the replies of its clients."""
    for each in tables:
        yield from map(_topic, each.subscriptions.of(owner))
        yield from map(_request, each.servers.of(owner))
        yield from map(_reply, each.clients.of(owner))


def all_ends(tables: Iterable[Any]) -> Iterator[Pair]:
    """Yield all topics, and both topics of each service."""
    for each in tables:
        for topics in (each.publishers, each.subscriptions):
            yield from map(_topic, topics.pairs())
        for services in (each.servers, each.clients):
            for pair in services.pairs():
                yield from (_request(pair), _reply(pair))


def _topic(pair: Pair) -> Pair:
    return f"{TOPIC}{pair[0]}", type_name(pair[1])


def _request(pair: Pair) -> Pair:
    return f"rq{pair[0]}Request", type_name(f"{pair[1]}_Request")


def _reply(pair: Pair) -> Pair:
    return f"rr{pair[0]}Reply", type_name(f"{pair[1]}_Response")


def type_name(name: str) -> str:
    """`std_msgs/msg/String` as `std_msgs::msg::dds_::String_`."""
    package, kind, short = name.split("/")
    return f"{package}::{kind}::dds_::{short}_"
