"""Endpoints of one topic and type communicate only if their definitions agree; otherwise it is reported, once."""

from __future__ import annotations

import io
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.runtime.rmw.zenoh.type_agreement import has_same_type

ENDPOINT: Any = SimpleNamespace(topic="/scan", type_name="a/msg/Scan")
KEY = "0/scan/a::msg::dds_::Scan_/RIHS01_1"


@pytest.mark.parametrize(
    ("type_name", "type_hash", "came", "same", "reported"),
    [
        ("a/msg/Scan", "RIHS01_1", True, True, 0),
        ("b/msg/Scan", "RIHS01_1", True, False, 0),
        ("a/msg/Scan", "RIHS01_2", True, False, 1),
        ("a/msg/Scan", "RIHS01_2", False, False, 0),
    ],
)
def test_differing_definition_is_reported_once(
    type_name: str, type_hash: str, came: bool, same: bool, reported: int
) -> None:
    process: Any = SimpleNamespace(name="laser", notices=[], stderr=io.StringIO())
    node = SimpleNamespace(namespace="/robot", name="lidar")
    token: Any = SimpleNamespace(type_name=type_name, type_hash=type_hash, node=node)
    for _ in range(2):
        assert has_same_type(process, ENDPOINT, KEY, token, came) is same
    assert len(process.notices) == reported
    assert all(
        "'/scan': a/msg/Scan" in each and "node /robot/lidar (hash RIHS01_2)" in each for each in process.notices
    )
