"""Topics: measured while visible, read as a tree, published; services called, goals sent and cancelled."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo, RateCheck
from bot_console.tui.console.topics.port import Field, Reply, RequestedQos
from bot_console.tui.panes.topics.pane import TopicsPane
from bot_console.tui.panes.topics.rows import Kind
from bot_console.tui.panes.topics.table import TopicRows, heading
from bot_console.tui.widgets.static_text import StaticText
from fleet import fleet
from geometry_msgs.msg import Twist
from piloting import Clock, Session, run
from samples import ODOM, ODOM_TOPIC, graph, live, odometry

SIZE = (100, 30)
SET_BOOL, FIBONACCI = "std_srvs/srv/SetBool", "example_interfaces/action/Fibonacci"


def graph_with_services() -> GraphInfo:
    """The robot's graph with an additional service and action."""
    known = graph()
    server = NodeInfo(
        "/server",
        services=(Endpoint("/enable", (SET_BOOL,)),),
        action_servers=(Endpoint("/count", (FIBONACCI,)),),
    )
    return replace(known, nodes=(*known.nodes, server), services=(Endpoint("/enable", (SET_BOOL,)),))


def tick(session: Session, seconds: float = 1.0) -> None:
    """Let time pass."""
    pane = session.pane(TopicsPane)
    pane.clock.now += seconds
    pane.tick()


async def open_pane(session: Session, *keys: str) -> TopicsPane:
    """Open the pane with a clock that the test steps."""
    pane = session.pane(TopicsPane)
    pane.clock = Clock()
    await session.press("9", *keys)
    tick(session)
    await session.settle()
    return pane


async def at(session: Session, name: str) -> None:
    """Put the cursor on a row."""
    rows = session.pane(TopicRows)
    rows.cursor = [each.name for each in rows.rows].index(name)
    await session.settle()


@pytest.mark.slow
def test_heading_fits_the_columns_of_a_list_that_is_laid_out_after_the_pane() -> None:
    async def play(session: Session) -> None:
        pane = await open_pane(session)
        rows, title = pane.query_one(TopicRows), pane.query_one("#topics-heading", StaticText)
        assert str(title.content) == heading(rows.columns(rows.across), Kind.TOPICS)
        rows.styles.width = rows.across - 8
        await session.settle()
        assert str(title.content) == heading(rows.columns(rows.across), Kind.TOPICS)

    run(live(), play, SIZE)


def test_figures_change_once_a_second_however_often_the_system_changes() -> None:
    async def play(session: Session) -> None:
        pane = await open_pane(session)
        topics = session.console.topics
        topics.figures["/odom"] = replace(topics.figures["/odom"], rate=20.0)
        drive = session.console.current.drive
        for speed in (0.1, 0.2):
            session.console.change(drive=replace(drive, actual=(speed, 0.0)))
            await session.settle()
            assert any("/odom" in each and " 50 " in each for each in session.lines())
        pane.clock.now += 1.0
        session.console.change(drive=drive)
        await session.settle()
        assert any("/odom" in each and " 20 " in each for each in session.lines())

    run(live(), play)


def test_topics_show_rates_and_faults() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        line = next(each for each in session.lines() if "/odom" in each)
        assert "1/3" in line and " 50 " in line and "37 kB" in line and "2.1 ms" in line
        await at(session, "/cmd_vel_teleop")
        assert "!/cmd_vel_teleop" in session.text() and "nobody publishes it" in session.text()
        await session.press("E")
        await session.paste("/r/rates.yaml")
        await session.press("enter")
        assert ("expect", "/r/rates.yaml") in session.console.asked

    run(live(), play, SIZE)


@pytest.mark.slow
def test_expected_rates_come_from_a_file_and_show_what_is_late_here_and_in_alarms(tmp_path) -> None:
    file = tmp_path / "expected.yaml"
    checks = (
        RateCheck("/odom", "100 Hz ± 20 %", "50 Hz", True, times=1),
        RateCheck("/scan", "10 Hz ± 20 %", "10 Hz", False),
    )

    async def play(session: Session) -> None:
        await open_pane(session, "E")
        await session.paste(str(file))
        await session.press("enter")
        assert ("expect", str(file)) in session.console.asked
        session.console.change(rate_checks=checks)
        await session.settle()
        await at(session, "/odom")
        assert "!/odom" in session.text() and "50 Hz, expected 100 Hz ± 20 %" in session.text()
        await at(session, "/scan")
        assert "!/scan" not in session.text() and "expected 10 Hz ± 20 %  sensor_msgs" in session.text()
        await session.press("B")
        assert "✗ active" in session.text() and "1 of 2 active" in session.text()
        asked = len(session.console.asked)
        await session.press("d", "enter")
        assert "not an alarm" in session.text() and len(session.console.asked) == asked
        await session.press("9", "E", "ctrl+u", "enter")
        assert ("expect", "") in session.console.asked

    run(live(), play, SIZE)


def test_rates_are_provisional_until_three_seconds_are_measured() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        figures = session.console.topics.figures
        figures["/odom"] = replace(figures["/odom"], provisional=True)
        tick(session)
        await session.settle()
        assert " ~50 " in next(each for each in session.lines() if "/odom" in each)
        figures["/odom"] = replace(figures["/odom"], provisional=False)
        tick(session)
        await session.settle()
        assert "~" not in session.text()

    run(live(), play, SIZE)


def test_newest_values_are_a_column_and_follow_the_messages() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        assert "value" in session.text() and "x 2.50 m  y -1.20 m" in next(
            each for each in session.lines() if "/odom" in each
        )
        session.console.topics.values["/odom"] = "x 3.25 m"
        tick(session)
        await session.settle()
        line = next(each for each in session.lines() if "/odom" in each)
        assert "x 3.25 m" in line and "2.50" not in line

    run(live(), play, (80, 24))


@pytest.mark.slow
def test_namespaces_of_a_fleet_start_folded_and_unfold_one_by_one() -> None:
    def names(session: Session) -> list[str]:
        return [each.name for each in session.pane(TopicRows).rows]

    async def play(session: Session) -> None:
        await open_pane(session)
        assert names(session) == [
            "/clock", "/fleet", "/map", "/parameter_events", "/robot1", "/robot2", "/robot3", "/robot4", "/rosout",
        ]  # fmt: skip
        assert "▸ /robot2" in session.text() and "14 topics" in session.text()
        measured = session.console.topics.measuring
        assert "/clock" in measured and not any(each.startswith("/robot") for each in measured), "nobody sees them"
        await at(session, "/robot2")
        await session.press("enter")
        assert "/robot2/odom" in names(session) and "/robot1/odom" not in names(session)
        assert "/robot2/odom" in session.console.topics.measuring
        await at(session, "/robot2/odom")
        await session.press("left")
        assert session.pane(TopicRows).current.name == "/robot2" and "/robot2/odom" not in names(session)
        await session.press("slash", *"vel", "enter")
        assert [each for each in names(session) if each.endswith("vel")] == [
            f"/robot{at}/cmd_vel" for at in range(1, 5)
        ]
        await session.press("C")
        assert names(session) == [f"/robot{at}" for at in range(1, 5)]
        await session.press("escape")
        assert "/fleet" in names(session) and "/robot2/odom" not in names(session), "as before the filter"
        await session.press("C")
        assert len(names(session)) > 60
        await session.press("C", "p", "P", "y", "x", "Q")
        assert session.pane(TopicRows).current is not None, "a key for topics does nothing on a namespace"

    run(fleet(), play, SIZE)


def test_fault_in_a_folded_namespace_is_marked_on_its_row() -> None:
    topics = tuple(Endpoint(f"/arm/t{number}", ("std_msgs/msg/Float64",)) for number in range(50))
    extra = Endpoint("/clock", ("std_msgs/msg/Float64",))

    async def play(session: Session) -> None:
        nodes = NodeInfo("/n", (*topics[1:], extra)), NodeInfo("/m", (), topics)
        session.console.change(graph=GraphInfo(nodes, (*topics, extra)))
        await open_pane(session)
        assert "!▸ /arm" in session.text() and "!/arm" not in session.text()
        await at(session, "/arm")
        assert "/arm/t0: nobody publishes it" in session.text()

    run(live(), play, SIZE)


def test_only_visible_rows_are_measured() -> None:
    topics = tuple(Endpoint(f"/t{number:03}", ("std_msgs/msg/Float64",)) for number in range(300))

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo((NodeInfo("/n", topics),), topics))
        pane = await open_pane(session)
        measuring = session.console.topics.measuring
        assert "/t000" in measuring and 10 < len(measuring) < 30
        await session.press("G")
        tick(session)
        assert "/t299" in session.console.topics.measuring and "/t000" not in session.console.topics.measuring
        await session.press("1")
        pane.tick()
        assert session.console.topics.measuring == ()

    run(live(), play, SIZE)


def test_newest_message_is_a_tree_that_can_be_frozen_and_folded() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        await at(session, ODOM_TOPIC)
        await session.press("enter")
        assert "2.5 m" in session.text() and "yaw 90.0°" in session.text() and "0.58 m/s" in session.text()
        assert "36 values" in session.text()
        await session.press("space")
        moved = odometry()
        moved.pose.pose.position.x = 3.5
        session.console.topics.hear(moved, ODOM)
        tick(session)
        await session.settle()
        assert "+1 new" in session.text() and "2.5 m" in session.text()
        await session.press("space")
        assert "3.5 m" in session.text() and "frozen" not in session.text()
        await session.press("down", "down", "down", "down", "left")
        assert "3.5 m" not in session.text(), "the content of the pose is folded"
        session.console.topics.cannot_hear(f"{'the type of this topic ' * 5}is not known")
        tick(session)
        await session.settle()
        assert "is not known" in session.text(), "a reason has as many lines as it needs"
        await session.press("escape")
        assert session.console.topics.listening == ""

    run(live(), play, SIZE)


@pytest.mark.slow
def test_topic_names_beside_a_message_are_cut_in_the_middle() -> None:
    ends = ("colour/image_raw", "depth/image_raw", "info")
    deep = [f"/cell_3{at}/perception/front/left/camera/{each}" for at, each in enumerate(ends)]
    topics = tuple(Endpoint(each, ("std_msgs/msg/Float64",)) for each in deep)

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo((NodeInfo("/n", topics),), topics))
        await open_pane(session)
        await at(session, deep[1])
        await session.press("enter")
        left = [each.partition("│")[2].split()[0] for each in session.lines() if "/cell_3" in each][:3]
        assert len(set(left)) == 3 and all(each.startswith("/cell_3") for each in left), left
        assert [each.rpartition("/")[2] for each in left] == ["image_raw", "image_raw", "info"]
        assert session.pane(TopicRows).opened == deep[1]
        name, other = (session.pane(TopicRows).row(at, 45)[2] for at in (1, 0))
        assert name.style and name.style.bold and name.style != other.style
        await session.press("escape")
        assert not session.pane(TopicRows).opened

    run(live(), play, (120, 40))


def test_a_field_at_the_cursor_is_plotted() -> None:
    async def play(session: Session) -> None:
        session.console.series["/cmd_vel/linear.x"] = ([1.0], [1.0])
        await open_pane(session)
        await at(session, "/cmd_vel")
        session.console.topics.messages["/cmd_vel"] = (Twist(), "geometry_msgs/msg/Twist")
        await session.press("enter", "down", "p")
        assert ("watch", "/cmd_vel/linear.x") in session.console.asked
        await session.press("9", "escape", "p")
        assert "/cmd_vel/linear.x" in session.text(), "the list offers the numbers of the topic"

    run(live(), play, SIZE)


def test_a_message_is_filled_in_and_published_once_and_at_a_rate() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        await at(session, "/cmd_vel")
        await session.press("P")
        assert "Enter OK" not in session.text()
        await session.press("enter")
        await session.type("fast")
        assert "not a number" in session.text() and "─ Enter OK · Esc Cancel ─" in session.text()
        await session.press("ctrl+u")
        await session.type("0.5")
        await session.press("enter")
        assert "─ Enter Edit · s Send once" in session.text()
        await session.press("s", "r", "enter")
        asked = session.console.asked
        assert ("publish", "/cmd_vel", {"linear.x": "0.5"}, 0.0) in asked
        assert ("publish", "/cmd_vel", {"linear.x": "0.5"}, 10.0) in asked
        await session.press("escape")
        tick(session)
        await session.settle()
        assert "▶" in session.text()
        await session.press("exclamation_mark")
        assert session.console.topics.repeated() == {}, "an all-stop ends publishing that drives the robot"

    run(live(), play, SIZE)


def test_earlier_sent_messages_are_recalled() -> None:
    async def play(session: Session) -> None:
        session.console.topics.remembered["/cmd_vel"] = [{"linear.x": "0.1"}, {"linear.x": "0.2"}]
        await open_pane(session)
        await at(session, "/cmd_vel")
        await session.press("P", "left_square_bracket")
        assert "0.2 m/s" in session.text()
        await session.press("left_square_bracket")
        assert "0.1 m/s" in session.text() and "2 of 2" in session.text()
        await session.press("right_square_bracket", "right_square_bracket", "s")
        assert session.console.asked[-1] == ("publish", "/cmd_vel", {}, 0.0)

    run(live(), play, SIZE)


@pytest.mark.slow
def test_quaternion_is_typed_as_yaw_and_stamp_as_now() -> None:
    async def play(session: Session) -> None:
        await open_pane(session)
        await at(session, ODOM_TOPIC)
        await session.press("P")
        assert "now s" in session.text()
        for _ in range(8):
            await session.press("down")
        assert "yaw" in session.text()
        rows = session.app.screen.query_one("SlotRows")
        rows.cursor = [each.path for each in rows.slots].index("pose.pose.orientation")
        await session.press("enter")
        session.app.focused.value = "90°"
        await session.press("enter", "s")
        assert session.console.asked[-1] == ("publish", ODOM_TOPIC, {"pose.pose.orientation": "90°"}, 0.0)

    run(live(), play, (100, 50))


def test_a_service_is_called_and_its_answer_shown() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=graph_with_services())
        session.console.topics.response = Reply(True, "", 0.0123, (Field("message", "message", 0, "string", "done"),))
        await open_pane(session, "m")
        await session.press("enter", "enter")
        await session.press("ctrl+u")
        await session.type("true")
        await session.press("enter", "s")
        assert ("call", "/enable", {"data": "true"}) in session.console.asked
        assert "answered after 12.3 ms" in session.text() and "message: done" in session.text()

    run(live(), play, SIZE)


def test_goal_is_sent_followed_and_cancelled() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=graph_with_services())
        await open_pane(session, "m", "m")
        await session.press("enter", "s")
        goals = session.console.topics.sent_goals
        progress = (Field("sequence", "sequence", 0, "sequence<int32>", "[0, 1]"),)
        goals["/count"] = replace(goals["/count"], feedback=progress, feedback_count=2)
        session.app.screen.poll()
        await session.settle()
        assert "executing" in session.text() and "2 feedback" in session.text() and "[0, 1]" in session.text()
        await session.press("x")
        session.app.screen.poll()
        await session.settle()
        assert "canceled" in session.text()

    run(live(), play, SIZE)


def test_built_in_services_are_hidden_by_default() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=graph_with_services())
        await open_pane(session, "m")
        assert "─ Services ─" in session.text()
        assert "/enable" in session.text() and "/set_parameters" not in session.text()
        await session.press("D")
        assert "/set_parameters" in session.text()

    run(live(), play, SIZE)


@pytest.mark.slow
def test_key_bar_describes_keys_for_topics_services_and_actions() -> None:
    async def play(session: Session) -> None:
        def bar() -> str:
            return session.lines()[-1]

        session.console.change(graph=graph_with_services())
        await session.press("9")
        assert all(each in bar() for each in ("enter Open", "P Publish", "p Plot", "m Services", "space Freeze"))
        for do, following in (("Call", "Actions"), ("Send a goal", "Topics")):
            await session.press("m")
            assert f"enter {do}" in bar() and f"m {following}" in bar()
            assert not any(each in bar() for each in ("Publish", "Plot", "Freeze", "Open"))
        await session.press("m")
        assert "P Publish" in bar() and "m Services" in bar()
        await session.press("m", "4")
        assert "enter Call" not in bar(), "a filter applies to its own pane only"

    run(live(), play, (140, 40))


@pytest.mark.slow
def test_key_bar_has_no_key_for_a_call_that_cannot_be_made() -> None:
    async def play(session: Session) -> None:
        def bar() -> str:
            return session.lines()[-1]

        pane = await open_pane(session, "m")
        assert "Call" not in bar(), "no service is listed"
        session.console.change(graph=graph_with_services())
        await session.settle()
        assert "enter Call" in bar()
        session.console.change(capabilities=replace(session.console.current.capabilities, change="read-only here"))
        await session.settle()
        assert "Call" not in bar()
        await at(session, "/enable")
        await session.press("enter")
        assert session.app.screen is pane.screen and "read-only here" in session.text()

    run(live(), play, (140, 40))


def test_open_topic_is_subscribed_to_with_the_chosen_qos() -> None:
    async def play(session: Session) -> None:
        pane = await open_pane(session)
        pane.go_to(ODOM_TOPIC)
        await session.press("enter", "Q", "pagedown", "enter")
        assert session.console.topics.qos == RequestedQos("reliable")

    run(live(), play, SIZE)


@pytest.mark.slow
def test_form_for_the_qos_of_the_open_topic_has_all_fields_and_explains_errors() -> None:
    async def play(session: Session) -> None:
        await session.press("9")
        pane = session.pane(TopicsPane)
        pane.go_to(ODOM_TOPIC)
        await session.settle()
        await session.press("enter", "Q")
        assert f"QoS of {ODOM_TOPIC}" in session.text() and "Enter Subscribe" in session.text()
        await session.press("pagedown", "down", "pagedown", "pagedown", "down", "down")
        await session.type("0")
        await session.press("enter")
        assert "depth must be a whole number from 1 to 10000" in session.text()
        await session.press("backspace")
        await session.type("5")
        await session.press("enter")
        asked = RequestedQos("reliable", "transient_local", "", 5)
        assert session.console.topics.qos == asked and session.console.topics.listening == ODOM_TOPIC
        assert "requested reliable transient local depth 5" in session.text()
        await session.press("Q", "pagedown", "enter")
        assert session.console.topics.qos == RequestedQos("best_effort", "transient_local", "", 5)

    run(live(), play, (120, 40))
