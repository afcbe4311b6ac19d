"""Liveliness tokens, which represent nodes, publishers, subscriptions, servers and clients in the graph."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal, NamedTuple, get_args

from bot_console.runtime.rmw.zenoh.wire.keys import FormatError, dds_type, demangle, mangle, ros_type
from bot_console.runtime.rmw.zenoh.wire.qos_text import WireQos, decode_qos

Kind = Literal["NN", "MP", "MS", "SS", "SC"]
"""Node, publisher, subscription, service server, service client."""

NODE_PARTS = 9
ENTITY_PARTS = 13
"""The number of slash-separated parts in a node's token, and in other entities' tokens."""
SPACE = "@ros2_lv"
NODES_OF_ALL_DOMAINS = f"{SPACE}/*/*/*/*/NN/**"
"""The key expression that matches the tokens of all nodes in all domains."""
DEFAULT_QOS = WireQos()
KINDS: tuple[str, ...] = get_args(Kind)


class TokenNode(NamedTuple):
    """The node named by a token; `zid` is the session's id, `number` the node's number in that session."""

    zid: str
    number: int
    enclave: str
    namespace: str
    name: str


class Token(NamedTuple):
    """A parsed token; `topic`, type and hash are empty for a node. `number` is the entity's number in its session."""

    key: str
    kind: Kind
    node: TokenNode
    number: int
    topic: str = ""
    type_name: str = ""
    type_hash: str = ""
    qos: WireQos = DEFAULT_QOS


def node_token(domain: int, node: TokenNode) -> str:
    """Return the token of a node."""
    return _head(domain, node, node.number, "NN")


def entity_token(
    domain: int, node: TokenNode, number: int, kind: Kind, topic: str, type_name: str, type_hash: str, qos: str
) -> str:
    """Return the token of a node's entity; `topic` is a fully qualified topic or service name, `qos` an encoded
    profile.
    """
    head = _head(domain, node, number, kind)
    return f"{head}/{mangle(topic)}/{dds_type(type_name)}/{type_hash}/{qos}"


def _head(domain: int, node: TokenNode, number: int, kind: Kind) -> str:
    names = f"{mangle(node.enclave)}/{mangle(node.namespace)}/{node.name}"
    return f"{SPACE}/{domain}/{node.zid}/{node.number}/{number}/{kind}/{names}"


def parse_token(key: str) -> Token:
    """Parse a token, ignoring unknown trailing parts. Raises `FormatError`."""
    parts = key.split("/")
    if len(parts) < NODE_PARTS or parts[0] != SPACE:
        raise FormatError(f"no liveliness token of ROS: {key!r}")
    kind = parts[5]
    if kind not in KINDS or (kind != "NN" and len(parts) < ENTITY_PARTS):
        raise FormatError(f"no liveliness token of ROS: {key!r}")
    node = _node(parts[1], parts[2], parts[3], parts[6], parts[7], parts[8])
    number = _natural(parts[4])
    if kind == "NN":
        return Token(key, "NN", node, number)
    topic, dds, type_hash, qos = parts[9:ENTITY_PARTS]
    known: Kind = kind  # pyright: ignore[reportAssignmentType] -- one of `KINDS`, as checked above
    return Token(key, known, node, number, demangle(topic), *_type(dds, type_hash), decode_qos(qos))


@lru_cache(1024)  # a node has dozens of entities
def _node(domain: str, zid: str, number: str, enclave: str, namespace: str, name: str) -> TokenNode:
    _natural(domain)
    return TokenNode(zid, _natural(number), demangle(enclave), demangle(namespace), name)


@lru_cache(1024)  # a graph of thousands of entities has dozens of types
def _type(dds: str, type_hash: str) -> tuple[str, str]:
    return ros_type(dds), type_hash


def _natural(part: str) -> int:
    if not (part.isascii() and part.isdecimal() and len(part) <= 20):
        raise FormatError(f"no number in a liveliness token: {part!r}")
    return int(part)


def all_tokens(domain: int) -> str:
    """Return the key expression that matches all tokens of a domain."""
    return f"{SPACE}/{domain}/**"


def tokens_of(domain: int, kind: Kind, topic: str) -> str:
    """Return the key expression that matches the tokens of one kind for one topic or service."""
    return f"{SPACE}/{domain}/*/*/*/{kind}/*/*/*/{mangle(topic)}/**"


def tokens_of_kind(domain: int, kind: Kind) -> str:
    """Return the key expression that matches all tokens of one kind."""
    return f"{SPACE}/{domain}/*/*/*/{kind}/**"


def topic_part(key: str) -> str | None:
    """Return the topic or service in a token as mangled in its key; None if it has none. Parses nothing else."""
    parts = key.split("/", NODE_PARTS + 1)
    return parts[NODE_PARTS] if len(parts) > NODE_PARTS else None
