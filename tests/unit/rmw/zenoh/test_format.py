"""The wire format of rmw_zenoh compared with captures of live nodes and with published hashes."""

import pytest
from bot_console.runtime.rmw.zenoh.wire.attachment import SEALED, gid_of, key_hash_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError, data_key, ros_type
from bot_console.runtime.rmw.zenoh.wire.qos_text import (
    Durability,
    History,
    Reliability,
    WireQos,
    decode_qos,
    encode_qos,
)
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, entity_token, node_token, parse_token
from bot_console.runtime.rosidl import type_hash
from example_interfaces.srv import AddTwoInts
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

STRING_HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
SCAN_HASH = "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"
TALKER = (
    "@ros2_lv/0/a52f44b281e33efee354a095ad96d9e9/0/11/MP/%/%/talker/%chatter/"
    f"std_msgs::msg::dds_::String_/{STRING_HASH}/::,7:,:,:,,"
)
SCAN = (
    "@ros2_lv/0/bc01d34e8cc07aeb6d6d61354c9fce76/0/5/MP/%/%/robot/%scan/"
    f"sensor_msgs::msg::dds_::LaserScan_/{SCAN_HASH}/2::,5:,:,:,,"
)
ATTACHMENT = bytes.fromhex("1a00000000000000 05301f32f9a2dc18 10 3e1e8c9234b1602a9dba5860eed86e33".replace(" ", ""))


def test_type_hashes_equal_published_ones():
    assert type_hash.text(String) == STRING_HASH
    assert type_hash.text(LaserScan) == SCAN_HASH
    assert type_hash.text(AddTwoInts).startswith("RIHS01_e118de6b")
    assert type_hash.text(AddTwoInts).endswith("c81a")


@pytest.mark.parametrize(("token", "depth", "reliability"), [(TALKER, 7, 1), (SCAN, 5, 2)])
def test_captured_token_survives_a_round_trip(token, depth, reliability):
    read = parse_token(token)
    assert (read.kind, read.qos.depth, read.qos.reliability) == ("MP", depth, reliability)
    reported = read.topic, read.type_name, read.type_hash, encode_qos(read.qos)
    assert entity_token(0, read.node, read.number, "MP", *reported) == token


def test_captured_attachment_survives_a_round_trip():
    attachment = unpack(ATTACHMENT)
    number, _, gid = attachment
    assert (number, gid) == (26, gid_of(TALKER))
    assert pack(*attachment) == ATTACHMENT


@pytest.mark.parametrize("size", [0, 1, 52, SEALED, SEALED + 1, 1_000_000])
def test_our_attachment_extends_that_of_rmw_zenoh_and_verifies_the_payload(size):
    attachment = unpack(ATTACHMENT)
    payload = bytes(size)
    data = pack(*attachment, payload)
    assert data.startswith(ATTACHMENT)
    assert unpack(data, payload) == unpack(data) == attachment
    for spoilt in (payload[:-1] + b"\1", payload + b"\0" if size < SEALED else payload[:-SEALED] + b"\1" * SEALED):
        with pytest.raises(FormatError, match="not what was sent"):
            unpack(data, spoilt)
    another = pack(attachment[0] + 1, *attachment[1:], payload)
    with pytest.raises(FormatError, match="not what was sent"):
        unpack(another[: len(ATTACHMENT)] + data[len(ATTACHMENT) :], payload)


def test_message_that_arrives_at_another_key_is_rejected():
    attachment, payload = unpack(ATTACHMENT), b"\0\1\0\0\0\0\0\0"
    data = pack(*attachment, payload, key_hash_of("0/arm/get_parameter_types/T/H"))
    assert unpack(data, payload, key_hash_of("0/arm/get_parameter_types/T/H")) == attachment
    with pytest.raises(FormatError, match="not what was sent here"):
        unpack(data, payload, key_hash_of("0/simulator/stop/T/H"))


@pytest.mark.parametrize("end", [b"xxh", b"xxh3", b"xxh3" + bytes(7), b"xxh4" + bytes(8), bytes(12)])
def test_attachment_with_an_unknown_end_is_rejected(end):
    with pytest.raises(FormatError, match="no attachment"):
        unpack(ATTACHMENT + end, b"")


def test_names_are_encoded_with_namespaces():
    node = TokenNode("abc", 3, "/", "/robot/arm", "driver")
    assert node_token(5, node) == "@ros2_lv/5/abc/3/3/NN/%/%robot%arm/driver"
    assert parse_token(node_token(5, node)).node == node
    assert data_key(5, "/robot/arm/scan", "std_msgs/msg/String", "H") == (
        "5/robot/arm/scan/std_msgs::msg::dds_::String_/H"
    )
    assert ros_type("rcl_interfaces::srv::dds_::SetParameters_") == "rcl_interfaces/srv/SetParameters"


@pytest.mark.parametrize(
    ("profile", "text"),
    [
        (QoSProfile(depth=10), "::,10:,:,:,,"),
        (QoSProfile(depth=42), "::,:,:,:,,"),
        (QoSProfile(depth=0), "::,:,:,:,,"),
        (QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT), "2::,5:,:,:,,"),
        (QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL), ":1:,1:,:,:,,"),
        (QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=10), "::2,10:,:,:,,"),
        (QoSProfile(depth=10, lifespan=Duration(seconds=10)), "::,10:,:10,0:,,"),
        (QoSProfile(depth=10, deadline=Duration(nanoseconds=5)), "::,10:0,5:,:,,"),
    ],
)
def test_qos_profiles_are_encoded(profile, text):
    assert encode_qos(profile) == text
    assert encode_qos(decode_qos(text)) == text


def test_omitted_qos_fields_take_defaults():
    assert decode_qos("::,:,:,:,,") == WireQos()
    assert decode_qos("2:1:2,:,:,:,,") == WireQos(Reliability.BEST_EFFORT, Durability.TRANSIENT_LOCAL, History.KEEP_ALL)


def test_parts_appended_by_later_releases_are_ignored():
    assert parse_token(SCAN + "/backends:cpu").qos == parse_token(SCAN).qos


def test_too_old_sender_is_distinguished_from_garbage():
    old = b"\x0fsequence_number" + bytes(40)
    with pytest.raises(FormatError, match="too old"):
        unpack(old)
    assert unpack(pack(15, 1, bytes(16))) == (15, 1, bytes(16))  # starts with the same byte
    for wrong in (None, b"", bytes(33), bytes(32)):
        with pytest.raises(FormatError):
            unpack(wrong)
