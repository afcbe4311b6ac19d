"""The line that says where the machine's ROS 2 looks for nodes follows the variables as rcl and its middleware do."""

import pytest
from bot_console.tui.session.machine.network_use import network_use

ONE, TWO = ["eth0 (192.0.2.2)"], ["eth0 (192.0.2.2)", "wlan0 (198.51.100.7)"]
RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"


@pytest.mark.parametrize(
    ("environ", "addresses", "line"),
    [
        ({}, ONE, "domain 0, range SUBNET, interface eth0 (192.0.2.2)"),
        ({"ROS_DOMAIN_ID": "7"}, TWO, "domain 7, range SUBNET, interfaces eth0 (192.0.2.2), wlan0 (198.51.100.7)"),
        ({RANGE: "SUBNET"}, [], "domain 0, range SUBNET, interface lo alone: no other one is up"),
        ({RANGE: "LOCALHOST"}, ONE, "domain 0, range LOCALHOST, this machine only (lo)"),
        ({RANGE: "subnet"}, ONE, "domain 0, range LOCALHOST, this machine only (lo)"),
        ({RANGE: "SUBNET", "ROS_LOCALHOST_ONLY": "1"}, ONE, "domain 0, range LOCALHOST, this machine only (lo)"),
        ({"ROS_LOCALHOST_ONLY": "0"}, ONE, "domain 0, range SUBNET, interface eth0 (192.0.2.2)"),
        (
            {RANGE: "LOCALHOST", "ROS_STATIC_PEERS": "robot;192.0.2.9"},
            ONE,
            "domain 0, range LOCALHOST, this machine (lo) and peers robot, 192.0.2.9",
        ),
        (
            {"ROS_STATIC_PEERS": "robot"},
            ONE,
            "domain 0, range SUBNET, interface eth0 (192.0.2.2) and peers robot",
        ),
        ({RANGE: "OFF"}, ONE, "domain 0, range OFF, which finds no other node"),
        (
            {RANGE: "SYSTEM_DEFAULT", "CYCLONEDDS_URI": "file:///c.xml"},
            ONE,
            "domain 0, range SYSTEM_DEFAULT, interfaces as in the file of CYCLONEDDS_URI",
        ),
    ],
)
def test_domain_range_and_interfaces_are_named(environ, addresses, line):
    assert network_use(environ, lambda: addresses) == line
