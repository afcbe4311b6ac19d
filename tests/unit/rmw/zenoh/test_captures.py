"""Captures of running systems, as `bot-console doctor --capture` writes them: each fits our format byte by byte."""

import json
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.qos_text import encode_qos
from bot_console.runtime.rmw.zenoh.wire.tokens import entity_token, node_token, parse_token

CAPTURES = sorted((Path(__file__).parents[3] / "captures").glob("*.json"))


def written(token):
    """The token as we would write it."""
    domain = int(token.key.split("/")[1])
    if token.kind == "NN":
        return node_token(domain, token.node)
    qos = token.key.split("/")[12]
    parts = (token.kind, token.topic, token.type_name, token.type_hash, qos)
    return entity_token(domain, token.node, token.number, *parts)


@pytest.fixture(params=CAPTURES, ids=lambda path: path.stem)
def capture(request):
    return json.loads(request.param.read_text(encoding="utf-8"))


def test_there_is_one():
    assert CAPTURES


def test_tokens_are_those_that_we_would_write(capture):
    for key in capture["tokens"]:
        assert "/".join(key.split("/")[:13]) == written(parse_token(key))


def test_attachments_are_those_that_we_would_write_and_name_their_publisher(capture):
    gids = {gid_of(each): each for each in capture["tokens"] if parse_token(each).kind == "MP"}
    for sample in capture["samples"]:
        data = bytes.fromhex(sample["attachment"])
        attachment = unpack(data)
        assert pack(*attachment) == data
        assert parse_token(gids[attachment[2]]).topic == sample["topic"]


def test_profiles_are_read_and_written_alike(capture):
    for key in capture["tokens"]:
        token = parse_token(key)
        if token.kind in ("MP", "MS"):
            assert encode_qos(token.qos) == key.split("/")[12]
