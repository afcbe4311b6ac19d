"""Types that only another terminal's workspace has: requested from its node, and compared with their hashes."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.console.topics.port import Payload, Slot, Topics
from bot_console.tui.session.embedded.domain import take_part
from bot_console.tui.session.embedded.hooks import DomainTypes
from processes.command_line import CommandLine, run_cli
from rigs import until

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

TIMEOUT_S = 240.0
PAINTER = """
import rclpy
import bot_console.runtime.rclpy.type_description_service as service
from false_shapes.action import Draw as FalseDraw
from false_shapes.msg import Spot as FalseSpot
from rclpy.action import ActionServer
from told_shapes.action import Draw
from told_shapes.msg import Path, Spot
from told_shapes.srv import Paint

whole = service._source
def shortened(name):
    reported = whole(name)
    if name.startswith("false_shapes"):
        reported.raw_file_contents = reported.raw_file_contents.replace("float64 y", "")
    return reported
service._source = shortened

def paint(request, response):
    response.painted = request.at.x + request.at.y
    return response

def draw(goal):
    goal.publish_feedback(Draw.Feedback(done=0.5))
    goal.succeed()
    return Draw.Result(drawn=[goal.request.to])

rclpy.init()
node = rclpy.create_node("painter")
publisher = node.create_publisher(Path, "spots", 1)
untrue = node.create_publisher(FalseSpot, "false_spots", 1)
node.create_service(Paint, "paint", paint)
drawing = ActionServer(node, Draw, "draw", draw)
falsely = ActionServer(node, FalseDraw, "draw_falsely", draw)
heard = node.create_publisher(Spot, "heard", 1)
node.create_subscription(Spot, "wanted", heard.publish, 1)
node.create_timer(0.1, lambda: (publisher.publish(Path(spots=[Spot(x=1.5)], tag="abc")), untrue.publish(FalseSpot())))
rclpy.spin(node)
"""
DEFINITIONS = {
    "told_shapes/msg/Spot.msg": "float64 x\nfloat64 y\n",
    "told_shapes/msg/Path.msg": "Spot[] spots\nstd_msgs/Header header\nstring<=5 tag\nint32 A=1\n",
    "told_shapes/srv/Paint.srv": "Spot at\nuint8 RED=1\nuint8 colour\n---\nfloat64 painted\n",
    "told_shapes/action/Draw.action": "# To\nSpot to\nint8 BY=2\nint8 how 2\n---\nSpot[] drawn\n---\nfloat32 done",
    "false_shapes/action/Draw.action": "float64 y\nfloat64 x\n---\n---\n",
    "false_shapes/msg/Spot.msg": "float64 x\nfloat64 y\n",
}


@pytest.fixture
def other_workspace(tmp_path: Path) -> Iterator[Path]:
    """A folder with the packages, outside the workspace, and a node running in it that uses them."""
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
    painter = CommandLine("run", str(file), cwd=file.parent)
    yield tmp_path / "elsewhere"
    painter.end(signal.SIGKILL)


def form_of(traffic: Topics, payload: Payload, type_name: str) -> Sequence[Slot]:
    """The form of a type, empty until its definition is known."""
    try:
        return traffic.slots(payload, type_name, {})
    except ValueError:
        return ()


def test_verb_reads_messages_by_definition_from_their_node_unless_hash_differs(other_workspace: Path) -> None:
    while "/spots" not in run_cli("topic", "list", cwd=other_workspace).stdout:
        pass
    echo = run_cli("topic", "echo", "--once", "/spots", cwd=other_workspace)
    assert echo.stdout.startswith("spots:\n- x: 1.5\n  y: 0.0\nheader:\n") and "tag: abc" in echo.stdout
    assert echo.returncode == 0
    untrue = run_cli("topic", "echo", "--once", "/false_spots", cwd=other_workspace)
    assert untrue.returncode == 1 and untrue.stdout == ""
    assert "'false_shapes/msg/Spot' of topic '/false_spots' is not installed here" in untrue.stderr
    assert "/painter describes it by a definition that does not have the hash RIHS01_" in untrue.stderr


@pytest.mark.slow
def test_bag_records_foreign_types_and_names_topics_without_definition_or_publisher(other_workspace: Path) -> None:
    while "/spots" not in run_cli("topic", "list", cwd=other_workspace).stdout:
        pass
    topics = "/spots", "/false_spots", "/nowhere"
    recorded = run_cli("bag", "record", "-o", "bag", "--duration", "4", *topics, cwd=other_workspace)
    assert recorded.returncode == 0, recorded.stderr
    ended = recorded.stderr.splitlines()[-1]
    assert "/false_spots was recorded without a definition" in ended
    assert "'/false_spots' is recorded without a definition: its type false_shapes/msg/Spot is not" in recorded.stderr
    assert "/nowhere was not recorded: nobody has published it" in ended and "/spots was" not in ended.split("; ")
    shown = run_cli("bag", "info", "bag", cwd=other_workspace).stdout
    assert "Topic: /spots | Type: told_shapes/msg/Path" in shown
    assert "Topic: /false_spots | Type: false_shapes/msg/Spot" in shown


@pytest.mark.slow
def test_verbs_send_goals_requests_and_messages_of_foreign_types(other_workspace: Path) -> None:
    while "/draw" not in run_cli("action", "list", cwd=other_workspace).stdout:
        pass
    assert "/draw [told_shapes/action/Draw]\n" in run_cli("action", "list", "-t", cwd=other_workspace).stdout
    info = run_cli("action", "info", "-t", "/draw", cwd=other_workspace)
    assert "Action servers: 1\n    /painter [told_shapes/action/Draw]\n" in info.stdout
    sent = run_cli(
        "action", "send_goal", "-f", "/draw", "told_shapes/action/Draw", "{to: {x: 1.5}}", cwd=other_workspace
    )
    assert (sent.stderr, sent.returncode) == ("", 0)
    assert "Sending goal:\n     to:\n  x: 1.5\n  y: 0.0\nhow: 2\n" in sent.stdout
    assert "Feedback:\n    done: 0.5\n" in sent.stdout and "Result:\n    drawn:\n- x: 1.5\n" in sent.stdout
    assert sent.stdout.endswith("Goal finished with status: SUCCEEDED\n")

    shown = run_cli("interface", "show", "told_shapes/action/Draw", cwd=other_workspace).stdout
    assert shown.startswith("# To\nSpot to\n\tfloat64 x\n\tfloat64 y\nint8 BY=2\nint8 how 2\n---\n")
    called = run_cli(
        "service", "call", "/paint", "told_shapes/srv/Paint", "{at: {x: 1.0, y: 2.0}}", cwd=other_workspace
    )
    assert called.stdout.endswith("told_shapes.srv.Paint_Response(painted=3.0)\n\n")
    published = run_cli("topic", "pub", "--once", "/wanted", "told_shapes/Spot", "{x: 4.0}", cwd=other_workspace)
    assert "publishing #1: told_shapes.msg.Spot(x=4.0, y=0.0)" in published.stdout

    wrong = run_cli("action", "send_goal", "/draw", "told_shapes/action/Drew", cwd=other_workspace)
    assert (wrong.stdout, wrong.stderr.strip(), wrong.returncode) == ("", "The passed action type is invalid", 1)
    untrue = run_cli("action", "send_goal", "/draw_falsely", "false_shapes/action/Draw", cwd=other_workspace)
    assert untrue.stdout == "" and untrue.returncode == 1
    assert "/painter describes it by a definition that does not have the hash RIHS01_" in untrue.stderr


def test_panes_show_plot_fill_in_and_call_foreign_types(other_workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(other_workspace)
    assert take_part() == ""
    console = RosConsole(types=DomainTypes())
    console.start()
    traffic = console.topics
    try:
        until(lambda: console.wait_ready(0) and "/spots" in str(console.snapshot().graph.topics), "the topics")
        traffic = console.topics
        traffic.listen("/spots")
        until(lambda: traffic.heard().count, "a message of a type that is not here")
        assert [(each.path, each.text) for each in traffic.heard().fields if each.text][-1] == ("tag", "abc")
        traffic.measure(["/spots"])
        until(lambda: any(each.rate for each in traffic.measured().values()), "it to be measured")

        assert "/spots/header.stamp.sec" in console.plots.plottable()
        until(lambda: console.plots.watch("/wanted/y").ok, "the other topic")
        assert not console.plots.watch("/spots").ok
        values = {"x": "0.5", "y": "2.25"}
        assert traffic.publish("/wanted", "told_shapes/msg/Spot", values, 20.0).ok
        until(lambda: 2.25 in console.plots.samples("/wanted/y", 0).values, "what was filled in")

        form = until(lambda: form_of(traffic, Payload.REQUEST, "told_shapes/srv/Paint"), "the service")
        assert [each.path for each in form] == ["at", "at.x", "at.y", "colour"]
        reply = traffic.call("/paint", "told_shapes/srv/Paint", {"at.x": "1.5", "at.y": "2.5"}).result(TIMEOUT_S)
        assert [(each.path, each.text) for each in reply.fields] == [("painted", "4")]

        form = until(lambda: form_of(traffic, Payload.GOAL, "told_shapes/action/Draw"), "the action")
        assert [each.path for each in form] == ["to", "to.x", "to.y", "how"]
        assert traffic.send_goal("/draw", "told_shapes/action/Draw", {"to.x": "2.5"}).ok
        drawn = lambda: (goal := traffic.goals().get("/draw")) and not goal.active and goal.feedback  # noqa: E731
        until(drawn, "the goal's end and its feedback, which come in any order")
        goal = traffic.goals()["/draw"]
        assert (goal.status, [each.text for each in goal.feedback]) == ("succeeded", ["0.5"])
        assert "2.5" in str(goal.result)

        traffic.listen("/false_spots")
        hashed = (
            "the type false_shapes/msg/Spot is not known here: /painter describes it by a definition that does not have"
        )
        until(lambda: traffic.heard().problem.startswith(hashed), "why the other is not read")
    finally:
        console.close()
