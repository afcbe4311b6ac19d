"""Profiles: differences are shown first, refusals and safety need confirmation, the world is changed on request."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.model import Capabilities, Endpoint, Profile, SetOutcome
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.panes.profiles.pane import ProfilesPane
from bot_console.tui.panes.profiles.rows import ProfileRows
from bot_console.tui.screens.confirm import ConfirmScreen
from piloting import Session, run
from samples import differences, live

SANITIZED = replace(differences()[0], unsafe="")


def applied(session: Session) -> list[tuple[str, bool]]:
    return [each[1:] for each in session.console.asked if each[0] == "apply"]


def test_differences_are_shown_before_applying_and_follow_the_parameters() -> None:
    async def play(session: Session) -> None:
        await session.press("7")
        assert "Nothing to change" in session.text()
        await session.press("down")
        text = session.text()
        assert "max_speed" in text and "1.0 → 3.0" in text
        assert "✗ would be refused" in text and "Parameter turn_rate must be within" in text
        assert "turns a protection off" in text and "needs a world reset" in text
        assert "4 changes, 1 would be refused" in text
        assert applied(session) == []
        await session.press("c")
        assert "1.0 → 3.0" not in session.text(), "all profiles side by side"
        await session.press("c")
        assert "1.0 → 3.0" in session.text()
        session.console.differences["competition"] = differences()[1:]
        session.console.change(parameters=dict(session.console.current.parameters))
        await session.settle()
        assert "3 changes" in session.text()
        assert session.pane(ProfilesPane).has_focus_within

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_profiles_are_compared_until_one_is_previewed_and_c_compares_all() -> None:
    async def play(session: Session) -> None:
        await session.press("7")
        row = next(line for line in session.lines() if "max_speed" in line)
        assert "1.0" in row and "3.0" in row and "⚠" in row and "→" not in row
        await session.press("down")
        assert "1.0 → 3.0" in session.text()
        await session.press("c")
        assert "1.0 → 3.0" not in session.text()
        assert any("max_speed" in line and "⚠" in line for line in session.lines())
        await session.press("c")
        assert "1.0 → 3.0" in session.text()

    run(live(), play, (80, 24))


def test_profiles_stay_compared_after_the_running_one_was_applied_again() -> None:
    async def play(session: Session) -> None:
        await session.press("7", "a", "y")
        assert "nothing to set" in session.text()
        assert any("max_speed" in line and "⚠" in line for line in session.lines())

    run(live(), play, (80, 24))


@pytest.mark.slow
def test_description_is_shown_in_full_at_80_columns_and_after_resizing() -> None:
    title = "Outdoor: higher speed, larger distances, and then so many words that no list has room for all of them"
    system = live()
    profile = replace(system[0].current.profiles[0], title=title)
    system[0].current = replace(system[0].current, profiles=(profile,))

    async def play(session: Session) -> None:
        await session.press("7")
        for width in (80, 62):
            await session.pilot.resize_terminal(width, 24)
            await session.settle()
            message = " ".join(" ".join(each.strip("│ ") for each in session.lines()).split())
            assert title in message

    run(system, play)


def test_profile_with_a_refusal_or_loss_of_safety_asks_and_no_applies_nothing() -> None:
    async def play(session: Session) -> None:
        await session.press("7", "down", "a")
        assert isinstance(session.app.screen, ConfirmScreen)
        assert "enable_safety true → false turns a protection off" in session.text()
        assert "max_speed 1.0 → 3.0 raises a safety limit" in session.text()
        await session.press("n")
        assert applied(session) == []
        await session.press("a", "y")
        assert applied(session) == [("competition", False)]
        assert "3 accepted, 1 refused" in session.text()
        assert "✗ refused" in session.text() and "Parameter turn_rate must be" in session.text()

    run(live(), play, (120, 40))


def test_safe_profile_is_applied_without_a_question() -> None:
    system = live()
    system[0].differences["competition"] = (SANITIZED,)

    async def play(session: Session) -> None:
        await session.press("7", "down", "a")
        assert applied(session) == [("competition", False)]
        assert "✓ accepted" in session.text() and "● competition" in session.text()
        await session.press("w")
        assert applied(session)[-1] == ("competition", True)
        assert "simulator was reset" in session.text()

    run(system, play, (120, 40))


def test_unreadable_profile_explains_how_to_fix_it() -> None:
    async def play(session: Session) -> None:
        await session.press("7", "down", "down", "a", "w")
        assert "two underscores" in session.text()
        assert applied(session) == []

    run(live(), play, (120, 40))


def test_error_while_applying_is_shown_in_the_pane() -> None:
    async def play(session: Session) -> None:
        failed: Future[tuple[object, ...]] = Future()
        failed.set_exception(RuntimeError("the node /robot_navigator does not answer"))
        session.console.differences["competition"] = (SANITIZED,)
        session.console.profiles.apply = lambda name, reset_world=False: failed  # type: ignore[assignment]
        await session.press("7", "down", "a")
        assert "was not applied: the node /robot_navigator does not answer" in session.text()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_list_of_differences_stays_while_values_are_applied() -> None:
    async def play(session: Session) -> None:
        slow: Future[tuple[object, ...]] = Future()
        session.console.differences["competition"] = (SANITIZED,)
        session.console.profiles.apply = lambda name, reset_world=False: slow  # type: ignore[assignment]
        await session.press("7", "down", "a")
        session.console.differences["competition"] = ()
        session.console.change(parameters=dict(session.console.current.parameters))
        await session.settle()
        assert "applying competition" in session.text() and "1.0 → 3.0" in session.text()
        slow.set_result((SetOutcome("/robot_navigator", "max_speed", 3.0, True),))
        await session.settle()
        assert "✓ accepted" in session.text()

    run(live(), play, (120, 40))


def test_node_that_can_check_values_is_asked_before_applying() -> None:
    console, *rest = live()
    console.differences["competition"] = (
        SANITIZED,
        replace(SANITIZED, node="/safety_monitor", name="warning_distance"),
    )
    check = Endpoint(f"{SANITIZED.node}/check_parameters", ("rcl_interfaces/srv/SetParametersAtomically",))
    console.change(graph=replace(console.current.graph, services=(*console.current.graph.services, check)))
    questions: list[tuple[str, Mapping[str, object]]] = []
    answers: list[Future[Answer]] = []

    def call(service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        questions.append((service, fields))
        answers.append(Future())
        return answers[-1]

    console.topics.call_service = call  # type: ignore[method-assign]

    async def play(session: Session) -> None:
        await session.press("7", "down")
        value = {"type": 3, "double_value": SANITIZED.then}
        assert questions == [(check.name, {"parameters": [{"name": SANITIZED.name, "value": value}]})]
        assert f"{SANITIZED.node}  checking ..." in session.text()
        assert "/safety_monitor  can't check in advance" in session.text()
        words = " ".join(session.text().replace("│", " ").split())
        assert "1 of 2 nodes can't check in advance: no service ~/check_parameters" in words
        answers[0].set_result(Answer(False, "not in this hall"))
        await session.settle()
        assert (
            "✗ checked:" in session.text()
            and "not in this hall" in session.text()
            and "1 node would refuse it" in session.text()
        )
        await session.press("a")
        assert "and with them all other values" in session.text() and applied(session) == []
        await session.press("n", "up", "down")
        assert len(questions) == 2, "viewing it again asks again"
        answers[1].set_result(Answer(True, ""))
        await session.settle()
        assert "checked: will accept" in session.text()
        await session.press("a")
        assert applied(session) == [("competition", False)]

    run((console, *rest), play, (120, 40))


def test_read_only_console_asks_no_node_to_check() -> None:
    console, *rest = live()
    console.differences["competition"] = (SANITIZED,)
    check = Endpoint(f"{SANITIZED.node}/check_parameters", ("rcl_interfaces/srv/SetParametersAtomically",))
    services = (*console.current.graph.services, check)
    console.change(graph=replace(console.current.graph, services=services), capabilities=Capabilities(change="no"))

    async def play(session: Session) -> None:
        await session.press("7", "down")
        text = session.text()
        assert SANITIZED.name in text and "checking ..." not in text and "would refuse it" not in text
        assert not [each for each in console.asked if each[0] == "call"]

    run((console, *rest), play, (120, 40))


@pytest.mark.slow
def test_long_list_of_differences_scrolls() -> None:
    system = live()
    many = tuple(replace(differences()[0], name=f"parameter_{at}") for at in range(60))
    system[0].differences["competition"] = many

    async def play(session: Session) -> None:
        await session.press("7", "down")
        assert "parameter_59" not in session.text()
        await session.press(*["right"] * 12)
        assert "parameter_59" in session.text() or "parameter_9" in session.text()

    run(system, play)


def test_cursor_follows_the_active_profile() -> None:
    system = live()
    system[0].change(active_profile="broken")

    async def play(session: Session) -> None:
        await session.press("7")
        assert session.pane(ProfileRows).current == session.console.current.profiles[2]
        session.console.change(active_profile="indoor", profile_changes=2)
        await session.settle()
        assert session.pane(ProfileRows).cursor == 0
        assert "● indoor" in session.text() and "indoor, 2 changed" in session.lines()[-2]
        await session.press("down")
        session.console.change(active_profile="broken")
        await session.settle()
        assert session.pane(ProfileRows).cursor == 1, "a person has selected another one"

    run(system, play, (160, 40))


@pytest.mark.slow
def test_status_line_counts_differences_from_the_profile() -> None:
    async def play(session: Session) -> None:
        assert "indoor" in session.lines()[-2] and "changed" not in session.lines()[-2]
        session.console.change(profile_changes=2)
        await session.settle()
        assert "indoor, 2 changed" in session.lines()[-2]

    run(live(), play, (160, 40))


def test_file_is_opened_and_running_values_are_saved_as_a_profile(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("# Mine.\n/robot_navigator:\n  ros__parameters: {turn_rate: 0.5, nobody: 1}\n/gone:\n"
                    "  ros__parameters: {x: 1}\n")  # fmt: skip

    async def play(session: Session) -> None:
        await session.press("7", "o")
        await session.paste(str(file))
        await session.press("enter")
        text = session.text()
        assert "turn_rate" in text and "1.0 → 0.5" in text and "unknown to its node" in text
        assert "1 change, 1 unknown to its node and left out, not running: /gone" in text
        await session.press("a")
        assert session.console.current.parameters["/robot_navigator"].get("turn_rate").value == 0.5
        await session.press("S", "ctrl+u")
        await session.type("hall")
        await session.press("enter")
        await session.paste("for the hall")
        await session.press("enter")
        assert ("save profile", "hall", "for the hall") in session.console.asked

    run(live(), play, (120, 40))


def test_a_launch_profile_that_ends_a_lock_names_who_holds_the_robot() -> None:
    console, launcher = live()
    two = Profile("two", "/p/two.yaml", "Two robots.", launch="/p/two.launch.py")
    lock = Endpoint("/emergency_stop/base", ("diagnostic_msgs/msg/DiagnosticStatus",))
    nodes = [replace(each, publishers=(*each.publishers, lock)) for each in console.current.graph.nodes]
    console.change(profiles=(*console.current.profiles, two), graph=replace(console.current.graph, nodes=tuple(nodes)))
    console.hold([RobotStop("1", "ben", "my foot")])

    async def play(session: Session) -> None:
        await session.press("7", "G", "a")
        assert "ends an emergency stop" in session.text() and "ben: my foot" in session.text()

    run((console, launcher), play, (120, 50))


def test_launch_profile_stops_the_system_before_launching() -> None:
    console, launcher = live()
    two = Profile("two", "/p/two.yaml", "Two robots.", launch="/p/two.launch.py", arguments={"robots": "2"})
    console.change(profiles=(*console.current.profiles, two))

    async def play(session: Session) -> None:
        await session.press("7", "G", "a")
        assert "Stop them, and launch two?" in session.text() and "robots:=2" in session.text()
        await session.press("n")
        assert launcher.asked == []
        await session.press("a", "y")
        await session.settle()
        verbs = [each[0] for each in launcher.asked]
        assert verbs == ["stop"] * (len(verbs) - 1) + ["launch"] and len(verbs) > 2
        assert launcher.asked[-1][1:] == ("/p/two.launch.py", {"robots": "2"})
        assert console.current.active_profile == "two"

    run((console, launcher), play, (120, 40))


def test_profile_from_a_url_is_shown_before_it_is_applied(tmp_path) -> None:
    path = tmp_path / "served.yaml"
    path.write_text("/robot_navigator: {ros__parameters: {max_speed: 1.5}}\n")

    async def play(session: Session) -> None:
        await session.press("7", "o")
        await session.paste("https://config.example/served.yaml")
        await session.press("enter")
        assert session.console.asked[-1] == ("fetch profile", "https://config.example/served.yaml")
        assert "fetching https://config.example/served.yaml ..." in session.text()
        session.console.fetching.set_result(session.console.profiles.open(str(path)))
        await session.settle()
        await session.settle()
        assert "fetching" not in session.text()
        assert "max_speed" in session.text()
        assert applied(session) == []

    run(live(), play)


@pytest.mark.parametrize(
    "more", [False, pytest.param(True, marks=pytest.mark.slow)], ids=["applied", "saved and deleted"]
)
def test_presets_of_a_node_are_applied_saved_and_deleted(more: bool) -> None:
    console, *rest = live()
    kept = {"careful": "slow and gentle"}
    offered = [("list", "std_srvs/srv/Trigger")]
    offered += [(verb, "diagnostic_msgs/srv/AddDiagnostics") for verb in ("apply", "save", "delete")]
    graph = replace(console.current.graph, services=tuple(Endpoint(f"/presets/{a}", (b,)) for a, b in offered))
    console.change(graph=graph)
    message: list[tuple[str, str]] = []

    def call(service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        verb, name = service.rpartition("/")[2], str(fields.get("load_namespace", ""))
        message.append((verb, name))
        if verb == "save":
            kept[name] = ""
        elif verb == "delete":
            kept.pop(name)
        listed = "\n".join(f"{name}: {title}" if title else name for name, title in kept.items())
        return done(Answer(True, listed if verb == "list" else f"{verb} {name}: all is well"))

    console.topics.call_service = call  # type: ignore[method-assign]

    async def play(session: Session) -> None:
        await session.press("7", "p")
        assert "apply careful" in session.text() and "slow and gentle" in session.text()
        await session.press("enter")
        assert "/presets sets the values itself" in session.text() and message == [("list", "")]
        await session.press("y")
        assert message[1:] == [("apply", "careful")] and "apply careful: all is well" in session.text()
        if not more:
            return
        await session.press("p", *"save", "enter", *"brisk", "enter")
        assert message[3:] == [("save", "brisk")]
        await session.press(
            "p", *"delete", "space", *"car", "enter", "n", "p", *"delete", "space", *"car", "enter", "y"
        )
        assert message[-1] == ("delete", "careful") and kept == {"brisk": ""}

    run((console, *rest), play, (120, 40))
