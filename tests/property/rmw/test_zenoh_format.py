"""Whatever arrives over the wire, the parsers of the format return a value or raise their one error."""

from contextlib import suppress

import pytest
from bot_console.runtime.rmw.zenoh.wire.attachment import pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError, ros_type
from bot_console.runtime.rmw.zenoh.wire.qos_text import decode_qos, encode_qos
from bot_console.runtime.rmw.zenoh.wire.tokens import SPACE, parse_token
from bot_console.runtime.rosidl.cdr import CdrError, deserialize
from hypothesis import given, settings
from hypothesis import strategies as st
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

PARTS = st.sampled_from(
    [*("", "%", "0", "7", "NN", "MP", "MS", "SS", "SC", "a::b::dds_::C_", "::,10:,:,:,,", "2:1:,5:,:,:,,", "²", "-1")]
)
TOKENS = st.lists(PARTS | st.text(max_size=6), max_size=16).map(lambda parts: "/".join([SPACE, *parts]))
PROFILES = st.text("0123456789:,-x²", max_size=30) | st.lists(PARTS, max_size=7).map(":".join)
HEADS = st.sampled_from([b"", b"\0\1\0\0", b"\0\0\0\0"])


def attempt(parse, given_value):
    try:
        return parse(given_value)
    except FormatError:
        return None


def check(token, profile, data, head):
    attempt(parse_token, token)
    attempt(ros_type, token)
    read = attempt(decode_qos, profile)
    if read is not None:
        assert decode_qos(encode_qos(read)) is not None
    found = attempt(unpack, data)
    assert found is None or data.startswith(pack(*found))
    for kind in (LaserScan, TFMessage):
        with suppress(CdrError):
            deserialize(head + data, kind)


ARGUMENTS = (TOKENS | st.text(), PROFILES, st.binary(max_size=200) | st.binary(min_size=33, max_size=33), HEADS)


@given(*ARGUMENTS)
def test_any_input_is_parsed_or_refused(token, profile, data, head):
    check(token, profile, data, head)


@pytest.mark.soak
@pytest.mark.timeout(1800)
@given(*ARGUMENTS)
@settings(max_examples=100_000, deadline=None)
def test_any_long_input_is_parsed_or_refused(token, profile, data, head):
    check(token, profile, data, head)
