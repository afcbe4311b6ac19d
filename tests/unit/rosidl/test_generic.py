"""Types without a definition: their messages are bytes, with the given type name and hash."""

import pytest
from bot_console.runtime.rosidl.cdr import deserialize, serialize
from bot_console.runtime.rosidl.conversion import type_name
from bot_console.runtime.rosidl.generic import generic_class
from bot_console.runtime.rosidl.type_hash import text

HASH = "RIHS01_" + "5a" * 32


def test_a_generic_class_has_the_given_name_and_hash():
    kind = generic_class("nobody_msgs/msg/Such", HASH)
    assert (type_name(kind), text(kind)) == ("nobody_msgs/msg/Such", HASH)
    assert kind is generic_class("nobody_msgs/msg/Such", HASH)


@pytest.mark.parametrize("data", [b"\x00\x01\x00\x00\x07\x00\x00", b"\x00\x00\x00\x00", b"\x00\x01\x00\x03abc"])
def test_its_messages_are_the_bytes_that_were_received(data):
    assert serialize(deserialize(data, generic_class("nobody_msgs/msg/Such", HASH))) == data


@pytest.mark.parametrize(
    ("name", "hashed"),
    [
        ("Such", HASH),
        ("nobody_msgs/Such", HASH),
        ("a b/msg/Such", HASH),
        ("nobody_msgs/msg/Such", ""),
        ("nobody_msgs/msg/Such", "INVALID"),
        ("nobody_msgs/msg/Such", HASH[:-2]),
        ("nobody_msgs/msg/Such", "RIHS02_" + "5a" * 32),
        ("nobody_msgs/msg/Such", "RIHS01_" + "zz" * 32),
    ],
)
def test_an_invalid_name_or_hash_is_refused(name, hashed):
    with pytest.raises(ValueError):
        generic_class(name, hashed)
