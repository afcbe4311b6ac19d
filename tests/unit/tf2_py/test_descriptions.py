"""The tree of frames as text. Contract: upstream's tf2."""

from __future__ import annotations

import pytest
from frames import frame
from tf2_py import BufferCore


@pytest.fixture
def buffer() -> BufferCore:
    found = BufferCore()
    for second in (1.0, 2.0, 4.0):
        found.set_transform(frame("map", "odom", second), "me" if second < 4 else "you")
    found.set_transform_static(frame("odom", "laser"), "them")
    found._take_later([frame("map", "odom", 5.25)])
    return found


def test_frames_are_described_in_lines(buffer: BufferCore) -> None:
    text = "Frame laser exists with parent odom.\nFrame odom exists with parent map.\n"
    assert buffer.all_frames_as_string() == text


def test_frames_are_described_in_yaml(buffer: BufferCore) -> None:
    assert BufferCore().all_frames_as_yaml() == "{}"
    assert buffer.all_frames_as_yaml() == (
        "laser: \n"
        "  parent: 'odom'\n"
        "  broadcaster: 'them'\n"
        "  rate: 10000.000\n"
        "  most_recent_transform: 0.000000\n"
        "  oldest_transform: 0.000000\n"
        "  buffer_length: 0.000\n"
        "odom: \n"
        "  parent: 'map'\n"
        "  broadcaster: 'default_authority'\n"
        "  rate: 0.941\n"
        "  most_recent_transform: 5.250000\n"
        "  oldest_transform: 1.000000\n"
        "  buffer_length: 4.250\n"
    )


def test_frames_are_described_as_a_dot_graph(buffer: BufferCore) -> None:
    assert buffer._allFramesAsDot() == (
        "digraph G {\n"
        '"odom" -> "laser"[label="Broadcaster: them\\nAverage rate: 10000.000"];\n'
        '"map" -> "odom"[label="Broadcaster: default_authority\\nAverage rate: 0.941"];\n'
        "}"
    )
