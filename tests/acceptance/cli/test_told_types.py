"""A type that only another terminal's workspace has: asked from the node there, and held against its hash."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)

PATIENCE = 60.0
PUBLISHER = """
import rclpy
from told_shapes.msg import Path, Spot

rclpy.init()
node = rclpy.create_node("painter")
publisher = node.create_publisher(Path, "spots", 1)
node.create_timer(0.1, lambda: publisher.publish(Path(spots=[Spot(x=1.5)], tag="abc")))
rclpy.spin(node)
"""
LIES = """
import bot_console.runtime.rclpy.type_description_service as service
whole = service._source
def shortened(name):
    told = whole(name)
    told.raw_file_contents = told.raw_file_contents.replace("float64 y", "")
    return told
service._source = shortened
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A package of interfaces, and an empty folder beside it."""
    package = tmp_path / "here" / "src" / "told_shapes"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package format='3'><name>told_shapes</name></package>")
    (package / "msg" / "Spot.msg").write_text("float64 x\nfloat64 y\n")
    (package / "msg" / "Path.msg").write_text("Spot[] spots\nstd_msgs/Header header\nstring<=5 tag\nint32 A=1\n")
    (tmp_path / "elsewhere").mkdir()
    return tmp_path


def start(workspace: Path, text: str) -> Iterator[None]:
    """The publisher, in its workspace, until the test is over."""
    file = workspace / "here" / "painter.py"
    file.write_text(text)
    line = [sys.executable, "-m", "bot_console.tui", "run", str(file)]
    process = subprocess.Popen(line, cwd=workspace / "here")
    yield
    process.kill()
    process.wait()


def typed(workspace: Path, *words: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "bot_console.tui", *words]
    return subprocess.run(
        line, cwd=workspace / "elsewhere", capture_output=True, text=True, timeout=PATIENCE, check=False
    )


@pytest.fixture(params=[PUBLISHER, LIES + PUBLISHER], ids=["true", "false"])
def publisher(workspace: Path, request: pytest.FixtureRequest) -> Iterator[bool]:
    """Whether the node that publishes describes the type as it is."""
    started = start(workspace, request.param)
    next(started)
    while "/spots" not in typed(workspace, "topic", "list").stdout:
        pass
    yield request.param == PUBLISHER
    next(started, None)


def test_messages_are_read_by_what_their_node_tells_unless_it_has_another_hash(
    workspace: Path, publisher: bool
) -> None:
    echo = typed(workspace, "topic", "echo", "--once", "/spots")
    if publisher:
        assert echo.stdout.startswith("spots:\n- x: 1.5\n  y: 0.0\nheader:\n") and "tag: abc" in echo.stdout
        assert echo.returncode == 0
    else:
        assert echo.returncode == 1 and echo.stdout == ""
        assert "'told_shapes/msg/Path' of topic '/spots' is not installed here" in echo.stderr
        assert "does not have the hash RIHS01_" in echo.stderr
