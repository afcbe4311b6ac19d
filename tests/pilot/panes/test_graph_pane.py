"""The node graph: drawn, selected, filtered, exported."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from bot_console.tui.console.sensors.frames import Frame, Frames
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.panes.graph.view import Mode
from bot_console.tui.widgets.diagram_view import DiagramView
from piloting import Clock, Session, run
from samples import graph, live


def picture(session: Session) -> DiagramView:
    return session.pane(GraphPane).query_one(DiagramView)


def items(session: Session) -> set[str]:
    return set(picture(session).places)


async def draw_topics(session: Session) -> None:
    """Open the graph, and switch from Flow to the mode in which all topics are separate items."""
    pane = session.pane(GraphPane)
    pane._view = replace(pane._view, mode=Mode.ACTIVE)
    await session.press("3", "m")
    assert pane.border_subtitle.startswith("Nodes/Topics (all)")


def colours(view: DiagramView, item: str) -> set[object]:
    """The colours of the line on which an item is drawn."""
    place = view.places[item]
    line = view.render_line(place.y + place.height // 2 - view.scroll_offset.y)
    return {each.style.color for each in line if each.style and item.rpartition("/")[2] in each.text}


def test_arrow_keys_follow_the_arrows_and_enter_shows_the_details() -> None:
    async def play(session: Session) -> None:
        await draw_topics(session)
        await session.press("o")
        view = picture(session)
        assert view.selected == "/simulator"
        await session.press("right")
        assert view.selected in ("topic:/odom", "topic:/scan_raw")
        await session.press("left")
        assert view.selected == "/simulator"
        await session.press("enter")
        assert "nav_msgs/msg/Odometry" in session.text() and "/simulator/set_parameters" in session.text()
        await session.press("escape", "right", "enter")
        assert "reliable volatile 10" in session.text()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_the_selected_item_is_always_in_view() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
        view = picture(session)
        for key in ("right", "right", "down", "right", "right", "down", "down", "up", "left"):
            await session.press(key)
            place = view.places[view.selected]
            left, top = view.scroll_offset
            assert left <= place.x < left + view.size.width, key
            assert top <= place.y < top + view.size.height, key

    run(live(), play)


def test_a_filter_keeps_what_matches_and_its_neighbours() -> None:
    async def play(session: Session) -> None:
        everything = items_before = None
        await draw_topics(session)
        everything = items_before = items(session)
        await session.press("slash")
        await session.paste("sensor !cmd_vel")
        await session.press("enter")
        assert items(session) == {"/sensor_handler", "topic:/scan_raw", "topic:/scan"}
        assert " of " in session.text()
        await session.press("escape")
        assert items(session) == items_before == everything
        await session.press("slash")
        session.app.focused.value = "re:("
        await session.settle()
        assert "regular expression" in session.text()
        session.app.focused.value = ""
        await session.paste("topic:cmd_vel_n")
        await session.press("right", "enter")
        assert session.pane(GraphPane).words == "topic:cmd_vel_nav"

    run(live(), play)


@pytest.mark.slow
def test_debug_topics_are_hidden_until_requested_and_dead_ends_can_be_hidden() -> None:
    async def play(session: Session) -> None:
        await draw_topics(session)
        assert "topic:/rosout" not in items(session)
        await session.press("D")
        assert "topic:/rosout" in items(session)
        await session.press("D", "d")
        assert "topic:/telemetry/speed" not in items(session)
        await session.press("d", *"mmm")
        assert not any(each.startswith("topic:") for each in items(session))

    run(live(), play)


@pytest.mark.slow
def test_a_topic_that_nobody_publishes_is_named_as_suspicious() -> None:
    async def play(session: Session) -> None:
        await draw_topics(session)
        picture(session).selected = "topic:/cmd_vel_teleop"
        await session.settle()
        assert "nobody publishes it" in session.text()

    run(live(), play, (120, 40))


def test_a_new_node_appears_and_the_selection_stays() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "right")
        before = picture(session).selected
        late = NodeInfo("/late", (), (Endpoint("/odom", ("nav_msgs/msg/Odometry",)),))
        session.console.change(graph=replace(graph(), nodes=(*graph().nodes, late)))
        await session.settle()
        assert "/late" in items(session) and picture(session).selected == before
        view = picture(session)
        place, alive = view.places["/late"], colours(view, "/late")
        session.console.change(graph=replace(graph(), nodes=(*graph().nodes, late), silent=("/late",)))
        await session.settle()
        assert view.places["/late"] == place and colours(view, "/late") != alive, "a silent node is grey"
        session.pane(GraphPane).tick()
        assert "graph" in session.console.sensors.watched_nodes
        await session.press("1")
        session.pane(GraphPane).tick()
        assert "graph" not in session.console.sensors.watched_nodes, "no node is asked while the pane is hidden"
        await session.press("3")
        session.console.change(graph=GraphInfo())
        await session.settle()
        assert "there are no nodes yet" in session.text()

    run(live(), play)


@pytest.mark.slow
def test_changes_made_while_the_pane_was_hidden_are_drawn_to_fit_the_pane() -> None:
    """A hidden widget has no size: the drawing for it must not be chosen for a pane of one cell."""
    longer = "/cell_3/perception/front"
    first = NodeInfo(
        f"{longer}/left_stereo_camera", (Endpoint(f"{longer}/left/image_raw", ("sensor_msgs/msg/Image",)),)
    )
    second = NodeInfo(
        f"{longer}/depth_from_stereo",
        (Endpoint(f"{longer}/depth/image_raw", ("sensor_msgs/msg/Image",)),),
        (Endpoint(f"{longer}/left/image_raw", ("sensor_msgs/msg/Image",)),),
    )
    third = NodeInfo(f"{longer}/obstacles", (), (Endpoint(f"{longer}/depth/image_raw", ("sensor_msgs/msg/Image",)),))

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo((first, second, third)))
        await session.press("3")
        before = dict(picture(session).places)
        assert picture(session).excess == 1.0
        await session.press("1")
        session.console.change(graph=GraphInfo((first, second, third), silent=(third.name,)))
        await session.settle()
        await session.press("3")
        assert picture(session).places == before

    run(live(), play, (120, 40))


def test_the_graph_is_exported_as_mermaid(tmp_path: Path) -> None:
    target = tmp_path / "g.mmd"

    async def play(session: Session) -> None:
        await session.press("3", "e")
        session.app.focused.value = str(target)
        await session.press("enter")

    run(live(), play)
    text = target.read_text()
    assert text.startswith("flowchart LR") and '(["/simulator"])' in text and "-->" in text


@pytest.mark.slow
def test_a_large_graph_is_laid_out_in_a_worker() -> None:
    nodes = tuple(
        NodeInfo(f"/n{at}", (Endpoint(f"/t{at}", ("a/msg/B",)),), (Endpoint(f"/t{at - 1}", ("a/msg/B",)),))
        for at in range(100)
    )

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo(nodes))
        await draw_topics(session)
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert len(items(session)) == 201
        await session.press("o")
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert "╭" in session.text()

    run(live(), play)


def fleet(count: int) -> GraphInfo:
    """Robots in namespaces, each with a LIDAR that offers best effort and a navigator that requests reliable."""
    kind = ("a/msg/B",)
    nodes, incompatible = [], {}
    for number in range(count):
        space = f"/robot_{number}"
        scan, odom = f"{space}/scan", f"{space}/odom"
        nodes += [
            NodeInfo(f"{space}/lidar", (Endpoint(scan, kind, "best effort volatile 5"),)),
            NodeInfo(f"{space}/drive", (Endpoint(odom, kind, "reliable volatile 10"),)),
            NodeInfo(f"{space}/nav", (), tuple(Endpoint(name, kind, "reliable volatile 10") for name in (scan, odom))),
        ]
        pair = IncompatiblePair(f"{space}/lidar", f"{space}/nav", "best effort publisher and reliable subscription")
        incompatible[scan] = (pair,)
    return GraphInfo(tuple(nodes), incompatible=incompatible)


def test_incompatible_qos_is_drawn_as_a_fault_and_explained() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=fleet(1))
        await session.press("3")
        assert "✗ " in session.text()
        line = "line:/robot_0/lidar>/robot_0/nav"
        assert picture(session)._faults == {("/robot_0/lidar", line), (line, "/robot_0/nav")}
        await session.press("w")
        assert "/robot_0/scan: nothing arrives from /robot_0/lidar at /robot_0/nav: best effort" in session.text()
        await session.press("enter")
        assert picture(session).selected == line
        await draw_topics(session)
        assert picture(session)._faults == {("topic:/robot_0/scan", "/robot_0/nav")}

    run(live(), play, (120, 40))


def test_namespaces_fold_into_boxes_and_unfold() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=fleet(2))
        await session.press("3")
        assert "/robot_0/lidar" in items(session)
        await session.press("F")
        assert items(session) == {"namespace:/robot_0", "namespace:/robot_1"}
        assert "▸ robot_0  3 nodes" in session.text()
        picture(session).choose("namespace:/robot_1")
        await session.press("enter")
        assert "/robot_1/lidar" in items(session) and "/robot_0/lidar" not in items(session)
        picture(session).choose("/robot_1/nav")
        await session.press("minus")
        assert "namespace:/robot_1" in items(session)

    run(live(), play, (120, 40))


def test_many_nodes_are_folded_automatically() -> None:
    async def play(session: Session) -> None:
        session.console.change(graph=fleet(20))
        await session.press("3")
        assert items(session) == {f"namespace:/robot_{number}" for number in range(20)}

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_unfolding_a_large_namespace_shows_its_namespaces_first() -> None:
    names = [f"/fleet/robot_{at % 10}/{part}_{at}" for at in range(100) for part in ("nav", "lidar")]
    nodes = tuple(NodeInfo(each) for each in names)

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo((*nodes, NodeInfo("/cell/a"), NodeInfo("/cell/b"))))
        await session.press("3")
        assert items(session) == {"namespace:/fleet", "namespace:/cell"}
        picture(session).choose("namespace:/fleet")
        await session.press("enter")
        robots = {f"namespace:/fleet/robot_{at}" for at in range(10)}
        assert items(session) == {"namespace:/cell", *robots}
        assert picture(session).selected == "namespace:/fleet/robot_0"
        await session.press("enter")
        assert "/fleet/robot_0/nav_0" in items(session) and "namespace:/fleet/robot_1" in items(session)
        session.console.change(graph=GraphInfo(nodes))
        await session.press("F", "F")
        assert items(session) == robots, "a single box for everything would be useless"

    run(live(), play, (120, 40))


def test_the_focus_goes_back_and_forth() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
        everything = items(session)
        picture(session).choose("/sensor_handler")
        await session.press("c")
        assert items(session) < everything and "around /sensor_handler, 1 hop" in session.text()
        near = items(session)
        await session.press("c")
        assert items(session) > near
        await session.press("b", "b")
        assert items(session) == everything
        await session.press("f")
        assert items(session) == near

    run(live(), play, (120, 40))


def test_services_and_actions_are_drawn_on_request() -> None:
    trigger = ("std_srvs/srv/Trigger",)
    nodes = (
        NodeInfo("/server", services=(Endpoint("/reset", trigger), Endpoint("/server/get_parameters", trigger))),
        NodeInfo("/client", clients=(Endpoint("/reset", trigger),), action_clients=(Endpoint("/go", ("a/action/B",)),)),
    )

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo(nodes))
        await draw_topics(session)
        assert items(session) == {"/server", "/client"}
        await session.press("s")
        assert items(session) == {"/server", "/client", "service:/reset", "action:/go"}
        assert ("/client", "service:/reset") in picture(session).drawing.edges
        assert "ser /reset" in session.text() and "act /go" in session.text()

    run(live(), play, (120, 40))


def test_rates_are_shown_on_the_lines_where_there_is_room_while_the_pane_is_visible() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(GraphPane)
        pane.clock = Clock()
        await session.press("3")
        pane.tick()
        await session.settle()
        assert "/odom" in session.console.topics.measuring
        assert "/telemetry/speed" not in session.console.topics.measuring, "it is on no line"
        assert "odom 50 Hz" in session.text()
        await session.press("1")
        pane.tick()
        assert session.console.topics.measuring == (), "nothing is measured while the pane is hidden"
        await session.press("3", "r")
        assert "50 Hz" not in session.text() and session.console.topics.measuring == ()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_rates_are_measured_on_request_where_there_is_no_room_for_them() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(GraphPane)
        pane.clock = Clock()
        await session.press("3")
        assert session.console.topics.measuring == (), "nothing is measured without a request"
        await session.press("r")
        assert "odom 50 Hz" in session.text()
        await session.press("r", *"mmm")
        pane.clock.now += 10
        await session.press("r")
        assert "/odom 50 Hz" in picture(session).drawing.text()

    run(live(), play)


def test_choosing_a_parameter_in_the_details_of_a_node_opens_its_pane() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
        picture(session).choose("/robot_navigator")
        await session.press("enter")
        await session.paste("max_speed")
        await session.press("enter")
        assert "[1 " in session.lines()[0], "the parameters pane is shown"

    run(live(), play)


@pytest.mark.slow
def test_choosing_an_item_in_the_details_goes_to_it() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
        picture(session).choose("/robot_navigator")
        await session.press("enter")
        assert "parameter max_speed" in session.text() and "process robot_navigator-5" in session.text()
        await session.paste("max_speed")
        await session.press("enter")
        assert "[1 " in session.lines()[0], "the parameters pane is shown"
        await session.press("3", "enter")
        await session.type("odom")
        await session.press("enter")
        line = "line:/simulator>/motion_controller"
        assert picture(session).selected == line and "/odom" in session.text(), "the line that shows the topic"
        await draw_topics(session)
        session.pane(GraphPane).go_to("/odom")
        assert picture(session).selected == "topic:/odom"

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_a_picture_has_a_map_only_where_it_does_not_fit() -> None:
    async def play(session: Session) -> None:
        def has_map() -> bool:
            return any(line.count("▏") and "●" in line for line in session.lines())

        session.console.change(graph=fleet(8))
        await session.press("3")
        await session.settle()
        assert picture(session).excess == 1.0 and not has_map()
        session.console.change(graph=fleet(13))
        await draw_topics(session)
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert has_map()

    run(live(), play, (120, 40))


def test_frames_of_tf2_are_received_only_while_they_are_shown() -> None:
    system = live()
    sensors = system[0].sensors
    sensors.tree = Frames((Frame("base", "odom", place=(1.0, 2.0, 0.0), rate=20.0, last_received=100.0),))

    async def play(session: Session) -> None:
        session.pane(GraphPane).clock = Clock()
        await session.press("3")
        assert not sensors.watched
        await session.press("t")
        assert sensors.watched and any("base" in each and "20.0 Hz" in each for each in session.lines())
        await session.press("t")
        assert not sensors.watched and picture(session).display

    run(system, play)


@pytest.mark.slow
def test_frames_of_tf2_replace_the_picture() -> None:
    system = live()
    console = system[0]
    heard = 1000.0
    console.sensors.tree = Frames(
        (
            Frame("base", "odom", place=(1.0, 2.0, 0.0), rate=20.0, last_received=heard, others=("map",)),
            Frame("laser", "base", fixed=True, last_received=heard),
            Frame("odom", "map", rate=20.0, last_received=heard - 4.0),
        ),
        moving_by=("/simulator",),
        fixed_by=("/mast",),
    )

    async def play(session: Session) -> None:
        clock = Clock()
        clock.now = heard
        await session.press("3")
        session.pane(GraphPane).clock = clock
        await session.press("t")
        lines = session.text().splitlines()
        shown = [" ".join(line.strip("│ ").split()) for line in lines if "/simulator" in line or "/mast" in line]
        assert shown == [
            "odom 20.0 Hz 4 s ✗ silent /simulator",
            "base 20.0 Hz now ✗ also in map /simulator",
            "laser fixed /mast",
        ]
        assert "frames of tf2 · 3 transforms · w 2 findings" in session.text()
        await session.press("down", "down")
        assert "base in odom  x 1.000  y 2.000" in session.text()
        await session.press("enter")
        assert "20.0 times a second" in session.text()
        await session.press("escape", "w")
        assert "base has more than one parent: map and odom" in session.text()
        await session.press("escape", "slash", *"laser", "enter")
        assert "laser in base" in session.text() and "frames of tf2 · /laser" in session.text()
        assert console.sensors.watched
        await session.press("escape", "t")
        assert not console.sensors.watched and picture(session).display

    run(system, play, (120, 40))


@pytest.mark.slow
def test_the_list_names_each_topic_with_its_publishers_and_subscribers() -> None:
    async def play(session: Session) -> None:
        await session.press("3", *"mmmm")
        assert session.pane(GraphPane).border_subtitle.startswith("List")
        text = " ".join(session.text().split()).replace("│ │", "")
        assert "/odom /simulator → /motion_controller /robot_navigator /telemetry_publisher" in text
        assert "/cmd_vel_teleop (none) → /safety_monitor" in text
        await session.press("down", "enter")
        assert "published by" in session.text()
        await session.press("escape", "m")
        assert session.pane(GraphPane).border_subtitle.startswith("Flow")

    run(live(), play, (80, 24))


@pytest.mark.slow
def test_the_robot_is_drawn_without_scrolling_at_80_columns_and_described_at_120() -> None:
    async def small(session: Session) -> None:
        await session.press("3")
        view = picture(session)
        assert view.excess == 1.0 and view.max_scroll_x == view.max_scroll_y == 0
        assert {"/simulator", "/safety_monitor", "line:/safety_monitor>/simulator"} <= items(session)
        assert "No publisher   cmd_vel_teleop" in session.text() and "telemetry ×2" in session.text()
        assert "Flow · 6 nodes · 6 of 9 topics · D 2 hidden" in session.text()
        assert "/simulator  publishes 2 + 2 hidden, subscribes to 1" in session.text()
        assert "×2 two topics of a namespace" in session.text() and "↺" not in session.text()
        await session.press("D")
        assert "of 11 topics · w" in session.text() and "/simulator  publishes 4, subscribes" in session.text()

    async def large(session: Session) -> None:
        await session.press("3")
        assert "sends  /scan_raw" in session.text() and "reads  /cmd_vel" in session.text()
        picture(session).choose("line:/safety_monitor>/simulator")
        await session.settle()
        assert "/cmd_vel  /safety_monitor → /simulator" in session.text()

    run(live(), small, (80, 24))
    run(live(), large, (120, 40))


@pytest.mark.slow
def test_the_filter_suggests_names() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "slash")
        await session.paste("topic:cmd_vel_n")
        await session.settle()
        await session.press("right", "enter")
        assert session.pane(GraphPane).words == "topic:cmd_vel_nav"
        assert items(session) == {
            "/motion_controller", "/safety_monitor", "line:/motion_controller>/safety_monitor",
        }  # fmt: skip

    run(live(), play)
