"""The tree of frames as text. Contract: upstream's tf2."""

from __future__ import annotations

import pytest
from frames import frame
from rclpy.time import Time
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
    text = "Frame odom exists with parent map.\nFrame laser exists with parent odom.\n"
    assert buffer.all_frames_as_string() == text
    assert buffer._getFrameStrings() == ["odom", "map", "laser"]
    buffer.clear()
    assert buffer.all_frames_as_string() == text.replace("map", "NO_PARENT")


def test_frames_are_described_in_yaml(buffer: BufferCore) -> None:
    assert BufferCore().all_frames_as_yaml() == "[]"
    assert buffer.all_frames_as_yaml() == (
        "odom: \n"
        "  parent: 'map'\n"
        "  broadcaster: 'default_authority'\n"
        "  rate: 0.941\n"
        "  most_recent_transform: 5.250000\n"
        "  oldest_transform: 1.000000\n"
        "  buffer_length: 4.250\n"
        "laser: \n"
        "  parent: 'odom'\n"
        "  broadcaster: 'them'\n"
        "  rate: 10000.000\n"
        "  most_recent_transform: 0.000000\n"
        "  oldest_transform: 0.000000\n"
        "  buffer_length: 0.000\n"
    )


def test_frames_are_described_as_a_dot_graph(buffer: BufferCore) -> None:
    odom = (
        '"map" -> "odom"[label="Broadcaster: default_authority\\nAverage rate: 0.941 Hz\\n'
        'Most recent transform: 5.250000 {odom}\\nBuffer length: 4.250 sec\\n"];\n'
    )
    laser = (
        '"odom" -> "laser"[label="Broadcaster: them\\nAverage rate: 10000.000 Hz\\n'
        'Most recent transform: 0.000000 {laser}\\nBuffer length: 0.000 sec\\n"];\n'
    )
    legend = (
        'edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        '"Recorded at time: 8.000000"[ shape=plaintext ] ;\n }->"map";\n'
    )
    assert buffer._allFramesAsDot() == f"digraph G {{\n{odom.format(odom='')}{laser.format(laser='')}}}"
    odom, laser = odom.format(odom="( 2.750 sec old)"), laser.format(laser="( 8.000 sec old)")
    assert buffer._allFramesAsDot(Time(seconds=8)) == f"digraph G {{\n{odom}{laser}{legend}}}"
    assert BufferCore()._allFramesAsDot() == 'digraph G {\n"no tf data recieved"}'
