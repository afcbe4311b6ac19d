"""Whether two processes agree on a type's definition; if they do not, neither receives the other's messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.endpoints import Endpoint
from bot_console.runtime.rmw.names import full_name
from bot_console.runtime.rmw.zenoh.wire.tokens import Token

if TYPE_CHECKING:
    from bot_console.runtime.process.roles import Warned


def has_same_type(process: Warned, endpoint: Endpoint, key: str, token: Token, came: bool) -> bool:
    """Whether messages can pass between our endpoint and a remote one that has appeared or disappeared.

    `key` is our endpoint's data key. A type with the same name but another definition is reported when it appears.
    """
    if token.type_name != endpoint.type_name:
        return False
    same = key.endswith("/" + token.type_hash)
    if came and not same:
        node = full_name(token.node.namespace, token.node.name)
        notify(
            process,
            f"'{endpoint.topic}': {endpoint.type_name} is defined otherwise in node {node} (hash {token.type_hash}), "
            "so no messages pass: build both from the same definition",
        )
    return same
