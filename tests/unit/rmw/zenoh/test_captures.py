"""Captures of running systems, as written by `bot-console doctor --capture`, agree with our format byte by byte.

`own.json` is from our runtime, `rmw_zenoh_cpp-0.2.10-jazzy.json` from rclpy nodes over rmw_zenoh_cpp and its router.
"""

import json
from pathlib import Path

import pytest
from bot_console.runtime.importer import is_embedded
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.qos_text import encode_qos
from bot_console.runtime.rmw.zenoh.wire.tokens import entity_token, node_token, parse_token
from bot_console.runtime.rosidl import type_hash
from rosidl_runtime_py.utilities import get_interface

CAPTURES = sorted((Path(__file__).parents[3] / "captures").glob("*.json"))


def as_we_write(token):
    """Return the token as we would write it."""
    domain = int(token.key.split("/")[1])
    if token.kind == "NN":
        return node_token(domain, token.node)
    qos = token.key.split("/")[12]
    parts = (token.kind, token.topic, token.type_name, token.type_hash, qos)
    return entity_token(domain, token.node, token.number, *parts)


@pytest.fixture(params=CAPTURES, ids=lambda path: path.stem)
def capture(request):
    return json.loads(request.param.read_text(encoding="utf-8"))


def test_captures_include_the_real_middleware():
    assert "rmw_zenoh_cpp-0.2.10-jazzy" in [each.stem for each in CAPTURES]


def test_tokens_are_written_identically(capture):
    for key in capture["tokens"]:
        assert "/".join(key.split("/")[:13]) == as_we_write(parse_token(key))


def test_attachments_are_written_identically_and_identify_the_publisher(capture):
    gids = {gid_of(each): each for each in capture["tokens"] if parse_token(each).kind == "MP"}
    for sample in capture["samples"]:
        data = bytes.fromhex(sample["attachment"])
        attachment = unpack(data)
        assert pack(*attachment) == data
        assert parse_token(gids[attachment[2]]).topic == sample["topic"]


def test_qos_profiles_are_written_identically(capture):
    for key in capture["tokens"]:
        token = parse_token(key)
        if token.kind != "NN":
            assert encode_qos(token.qos) == key.split("/")[12]


def test_captured_type_hashes_equal_ours(capture):
    tokens = [each for each in map(parse_token, capture["tokens"]) if each.kind != "NN"]
    captured = {each.type_name: each.type_hash for each in tokens if is_embedded(each.type_name.partition("/")[0])}
    assert captured == {name: type_hash.text(get_interface(name)) for name in captured}
    assert len(captured) > 10
