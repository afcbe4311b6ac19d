"""An endpoint of a captured node of rmw_zenoh_cpp, imitated on a bare session with the same token and attachments."""

import json
import time
from pathlib import Path

from bot_console.runtime.rmw.zenoh.network.client import open_network_session
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import data_key
from bot_console.runtime.rmw.zenoh.wire.tokens import parse_token
from rclpy.serialization import serialize_message

CAPTURE = Path(__file__).parents[2] / "captures" / "rmw_zenoh_cpp-0.2.10-jazzy.json"
BASE = "/%/%/base/"
TYPE, HASH, QOS = 10, 11, 12
"""Positions of these parts in a token."""


def captured(kind, topic):
    """The token of the captured node `base` for a publisher (MP) or subscription (MS)."""
    tokens = json.loads(CAPTURE.read_text(encoding="utf-8"))["tokens"]
    return next(each for each in tokens if f"/{kind}{BASE}{topic.replace('/', '%')}/" in each)


class CapturedNode:
    """An endpoint of the captured node, on a separate session."""

    def __init__(self, config, kind, topic, *, qos=None, cache=0, type_name="", type_hash=""):
        self.session = open_network_session(0, config)
        parts = captured(kind, topic).split("/")
        parts[2] = self.session.zid
        parts[TYPE] = type_name or parts[TYPE]
        parts[HASH] = type_hash or parts[HASH]
        parts[QOS] = qos or parts[QOS]
        self.token = parse_token("/".join(parts))
        key = data_key(0, topic, self.token.type_name, self.token.type_hash)
        self.heard, self.payloads = [], []
        if kind == "MP":
            self.publisher = self.session.declare_publisher(key, cache=cache)
        else:
            self.session.declare_subscriber(key, self._hear)
        self.session.declare_token(self.token.key)
        self.number = 0

    def _hear(self, data, attachment):
        self.payloads.append(bytes(data))
        self.heard.append(unpack(attachment))

    def send(self, message, stamp=None):
        """Publish a message, or serialized bytes, with the source timestamp `stamp` (ns)."""
        data = message if isinstance(message, bytes) else serialize_message(message)
        self.number += 1
        stamp = time.time_ns() if stamp is None else stamp
        self.publisher.put(data, pack(self.number, stamp, gid_of(self.token.key)))
