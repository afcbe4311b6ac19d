"""Types that only another terminal's workspace has: asked from the node there, and held against their hashes."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.cli.system.domain import take_part
from bot_console.tui.cli.system.type_source import DomainTypes
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.traffic import Payload
from rigs import until

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)

PATIENCE = 60.0
PAINTER = """
import rclpy
import bot_console.runtime.rclpy.type_description_service as service
from false_shapes.msg import Spot as FalseSpot
from told_shapes.msg import Path, Spot
from told_shapes.srv import Paint

whole = service._source
def shortened(name):
    told = whole(name)
    if name.startswith("false_shapes"):
        told.raw_file_contents = told.raw_file_contents.replace("float64 y", "")
    return told
service._source = shortened

def paint(request, response):
    response.painted = request.at.x + request.at.y
    return response

rclpy.init()
node = rclpy.create_node("painter")
publisher = node.create_publisher(Path, "spots", 1)
untrue = node.create_publisher(FalseSpot, "false_spots", 1)
node.create_service(Paint, "paint", paint)
heard = node.create_publisher(Spot, "heard", 1)
node.create_subscription(Spot, "wanted", heard.publish, 1)
node.create_timer(0.1, lambda: (publisher.publish(Path(spots=[Spot(x=1.5)], tag="abc")), untrue.publish(FalseSpot())))
rclpy.spin(node)
"""
DEFINITIONS = {
    "told_shapes/msg/Spot.msg": "float64 x\nfloat64 y\n",
    "told_shapes/msg/Path.msg": "Spot[] spots\nstd_msgs/Header header\nstring<=5 tag\nint32 A=1\n",
    "told_shapes/srv/Paint.srv": "Spot at\nuint8 RED=1\nuint8 colour\n---\nfloat64 painted\n",
    "false_shapes/msg/Spot.msg": "float64 x\nfloat64 y\n",
}


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[Path]:
    """A folder beside the workspace that has the packages, where a node runs that uses them."""
    source = tmp_path / "here" / "src"
    for name, text in DEFINITIONS.items():
        place = source / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        package = name.partition("/")[0]
        (source / package / "package.xml").write_text(f"<package format='3'><name>{package}</name></package>")
    (tmp_path / "elsewhere").mkdir()
    file = tmp_path / "here" / "painter.py"
    file.write_text(PAINTER)
    line = [sys.executable, "-m", "bot_console.tui", "run", str(file)]
    with subprocess.Popen(line, cwd=file.parent) as process:
        yield tmp_path / "elsewhere"
        process.kill()


def typed(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "bot_console.tui", *words]
    return subprocess.run(line, cwd=folder, capture_output=True, text=True, timeout=PATIENCE, check=False)


def test_a_verb_reads_messages_by_what_their_node_tells_unless_it_has_another_hash(elsewhere: Path) -> None:
    while "/spots" not in typed(elsewhere, "topic", "list").stdout:
        pass
    echo = typed(elsewhere, "topic", "echo", "--once", "/spots")
    assert echo.stdout.startswith("spots:\n- x: 1.5\n  y: 0.0\nheader:\n") and "tag: abc" in echo.stdout
    assert echo.returncode == 0
    untrue = typed(elsewhere, "topic", "echo", "--once", "/false_spots")
    assert untrue.returncode == 1 and untrue.stdout == ""
    assert "'false_shapes/msg/Spot' of topic '/false_spots' is not installed here" in untrue.stderr
    assert "/painter tells of it what does not have the hash RIHS01_" in untrue.stderr


def test_panes_show_plot_fill_in_and_call_what_a_node_tells_of(
    elsewhere: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(elsewhere)
    assert take_part() == ""
    console = RosConsole(types=DomainTypes())
    console.start()
    traffic = console.traffic
    try:
        until(lambda: console.wait_ready(0) and "/spots" in str(console.snapshot().graph.topics), "the topics")
        traffic = console.traffic
        traffic.listen("/spots")
        until(lambda: traffic.heard().count, "a message of a type that is not here")
        assert [(each.path, each.text) for each in traffic.heard().fields if each.text][-1] == ("tag", "abc")
        traffic.measure(["/spots"])
        until(lambda: any(each.rate for each in traffic.measured().values()), "it to be measured")

        assert "/spots/header.stamp.sec" in console.plottable()
        until(lambda: console.watch("/wanted/y").ok, "the other topic")
        assert not console.watch("/spots").ok
        values = {"x": "0.5", "y": "2.25"}
        assert traffic.publish("/wanted", "told_shapes/msg/Spot", values, 20.0).ok
        until(lambda: 2.25 in console.samples("/wanted/y", 0).values, "what was filled in")

        until(lambda: "told_shapes/srv/Paint" in str(console.snapshot().graph.services), "the service")
        form = traffic.slots(Payload.REQUEST, "told_shapes/srv/Paint", {})
        assert [each.path for each in form] == ["at", "at.x", "at.y", "colour"]
        reply = traffic.call("/paint", "told_shapes/srv/Paint", {"at.x": "1.5", "at.y": "2.5"}).result(PATIENCE)
        assert [(each.path, each.text) for each in reply.fields] == [("painted", "4")]

        traffic.listen("/false_spots")
        hashed = "the type false_shapes/msg/Spot is not known here: /painter tells of it what does not have the hash"
        until(lambda: traffic.heard().problem.startswith(hashed), "why the other is not read")
    finally:
        console.close()
