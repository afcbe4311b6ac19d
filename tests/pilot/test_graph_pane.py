"""The node graph: drawn, selected, filtered, exported."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.widgets.diagram_view import DiagramView
from piloting import Session, run
from samples import empty, graph, live


def picture(session: Session) -> DiagramView:
    return session.pane(GraphPane).query_one(DiagramView)


def items(session: Session) -> set[str]:
    return set(picture(session).places)


def test_arrow_keys_follow_the_arrows_and_enter_tells_all() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "o")
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
        await session.press("3")
        everything = items_before = items(session)
        await session.press("slash")
        await session.type("sensor !cmd_vel")
        await session.press("enter")
        assert items(session) == {"/sensor_handler", "topic:/scan_raw", "topic:/scan"}
        assert "hidden" in session.text()
        await session.press("escape")
        assert items(session) == items_before == everything

    run(live(), play)


def test_debug_topics_are_hidden_until_asked_for_and_dead_ends_can_go() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
        assert "topic:/rosout" not in items(session)
        await session.press("D")
        assert "topic:/rosout" in items(session)
        await session.press("D", "d")
        assert "topic:/telemetry/speed" not in items(session)
        await session.press("d", "m")
        assert not any(each.startswith("topic:") for each in items(session))

    run(live(), play)


def test_a_topic_that_nobody_publishes_is_named_as_suspicious() -> None:
    async def play(session: Session) -> None:
        await session.press("3")
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
        session.console.change(graph=GraphInfo())
        await session.settle()
        assert "No nodes yet" in session.text()

    run(live(), play)


def test_it_is_exported_as_mermaid(tmp_path: Path) -> None:
    target = tmp_path / "g.mmd"

    async def play(session: Session) -> None:
        await session.press("3", "e")
        await session.press(*["backspace"] * 9)
        session.app.focused.value = str(target)
        await session.press("enter")

    run(live(), play)
    text = target.read_text()
    assert text.startswith("flowchart LR") and '(["/simulator"])' in text and "-->" in text


def test_a_bad_pattern_is_explained_while_it_is_typed() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "slash")
        session.app.focused.value = "re:("
        await session.settle()
        assert "regular expression" in session.text()

    run(live(), play)


def test_an_empty_system_says_so() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "enter", "right")
        assert "No nodes yet" in session.text()

    run(empty(), play)


def test_a_large_graph_is_laid_out_beside_the_event_loop() -> None:
    nodes = tuple(
        NodeInfo(f"/n{at}", (Endpoint(f"/t{at}", ("a/msg/B",)),), (Endpoint(f"/t{at - 1}", ("a/msg/B",)),))
        for at in range(100)
    )

    async def play(session: Session) -> None:
        session.console.change(graph=GraphInfo(nodes))
        await session.press("3")
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert len(items(session)) == 201
        await session.press("o")
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert "╭" in session.text()

    run(live(), play)
