"""Data that other processes send: each function feeds a text to one parser, as bytes where the parser expects bytes."""

from __future__ import annotations

from collections.abc import Sequence


def token(text: str) -> None:
    """The liveliness token of a node or of one of its entities."""
    from bot_console.runtime.rmw.zenoh.wire.tokens import parse_token, topic_part

    topic_part(text)
    found = parse_token(text)
    assert "" not in (found.kind, found.node.name)
    found.topic.encode()


def token_seeds() -> Sequence[str]:
    from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, entity_token, node_token

    node = TokenNode("a1b2", 3, "/", "/arm", "talker")
    types = "std_msgs/msg/String", "RIHS01_" + "a" * 64
    return node_token(0, node), entity_token(0, node, 4, "MP", "/arm/chatter", *types, "::,7:,:,:,,")


def attachment(text: str) -> None:
    """The attachment of a message, and the message."""
    from bot_console.runtime.rmw.zenoh.wire.attachment import unpack

    data = text.encode("latin-1", "replace")
    unpack(data)
    unpack(data[:49], data[49:])


def attachment_seeds() -> Sequence[str]:
    from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, pack

    gid = gid_of("a token")
    return pack(1, 2, gid).decode("latin-1"), (pack(1, 2, gid, b"message") + b"message").decode("latin-1")


def news(text: str) -> None:
    """The notices that a launched process writes about itself into its data pipe."""
    from bot_console.runtime.launch.child.process_reports import NewsReader

    reader = NewsReader("talker-1")
    data = text.encode("utf-8", "surrogatepass")
    for at in range(0, len(data), 7):
        reader.feed(data[at : at + 7])
    reader.close()


NEWS = (
    '{"pid": 12, "kind": "notice", "text": "a"}\n{"pid": 12, "kind": "uncaught", "text": "b", "frames": [["f", 1]]}\n',
    'Fatal Python error: Segmentation fault\n{"kind": "declared", "node": "/n", "parameters": {"a": 1}}\n',
)


def terminal_input(text: str) -> None:
    """Terminal input: keys, pastes, mouse reports and answers to queries; a stop key after it is noticed."""
    from bot_console.tui.keymap import is_stop_key
    from bot_console.tui.keys.terminal_events import TerminalEvents
    from textual import events

    noticed: list[events.Key] = []
    reader = TerminalEvents(False, lambda key: is_stop_key(key.key), lambda key, alone: noticed.append(key))
    data = text.encode("utf-8", "surrogatepass")
    for at in range(0, len(data), 50):
        reader.feed(data[at : at + 50], at)
    reader.expire(len(data) + 1000.0)
    before = len(noticed)
    reader.feed(b"!", len(data) + 1001.0)
    assert len(noticed) == before + 1 or "\x1b[200~" in text, "the stop key was not noticed"


INPUT = (
    "abc\x1b[A\x1b[1;5C\x1bOP\x1bb\x1b[<35;10;20M\x1b[<65;1;1m!",
    "\x1b[200~a paste !\x1b[201~\x1b[?2026;2$y\x1b[97;5u\x1b[48;24;80;0;0t",
    "\x1b\x1b[A\x1b]11;rgb:0000/0000/0000\x1b\\\x1bP1+r\x1b\\q",
)
