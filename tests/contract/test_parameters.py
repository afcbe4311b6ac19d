"""The contract of `Console` for parameters: listed, described, set, refused with the reason, undone, in profiles."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import ChangeSource, Kind, ParameterInfo, Range, SetOutcome
from rigs import ARM, DESCRIPTION, ROBOT, TIMEOUT_S, TOO_FAST, Rig, until


def parameter(rig: Rig, name: str) -> ParameterInfo:
    """A parameter of the robot as the snapshot shows it."""
    found = rig.console.snapshot().parameters[ROBOT].get(name)
    assert found is not None
    return found


def setting(rig: Rig, values: dict[str, Any], node: str = ROBOT, *, atomically: bool = False) -> list[SetOutcome]:
    """Set values and wait for the outcomes."""
    return list(rig.console.parameters.set(node, values, atomically=atomically).result(TIMEOUT_S))


def wait_until_shown(rig: Rig, name: str, value: Any) -> None:
    """Wait until the snapshot shows a value."""
    until(lambda: parameter(rig, name).value == value, f"{name} = {value}")


def test_parameters_are_listed_and_described(rig: Rig) -> None:
    tree = rig.console.snapshot().parameters[ROBOT]
    assert {"speed", "count", "mode", "frame", "gains"} <= {each.name for each in tree.parameters}
    speed = parameter(rig, "speed")
    assert (speed.node, speed.kind, speed.value, speed.default, speed.changed) == (ROBOT, Kind.DOUBLE, 1.0, 1.0, False)
    assert (speed.range, speed.description, speed.unit) == (Range(0.0, 2.0), DESCRIPTION, "m/s")
    assert parameter(rig, "frame").read_only
    assert (parameter(rig, "gains").kind, parameter(rig, "gains").value) == (Kind.DOUBLE_ARRAY, (1.0, 2.0))


@pytest.mark.parametrize(
    ("name", "value"), [("speed", 1.5), ("speed", 2.0), ("count", -4), ("mode", "brave"), ("gains", (3.0,))]
)
def test_an_accepted_value_is_shown_and_recorded_in_the_journal(rig: Rig, name: str, value: Any) -> None:
    before = parameter(rig, name).value
    assert setting(rig, {name: value}) == [SetOutcome(ROBOT, name, value, True)]
    wait_until_shown(rig, name, value)
    assert parameter(rig, name).changed
    until(rig.console.parameters.changes, "the journal")
    (change,) = rig.console.parameters.changes()
    assert (change.node, change.name, change.old, change.new) == (ROBOT, name, before, value)
    assert (change.source, change.accepted, change.reason) == (ChangeSource.EDIT, True, "")


@pytest.mark.parametrize(
    ("node", "name", "value", "who"),
    [
        (ROBOT, "speed", 2.5, "descriptor"),
        (ROBOT, "speed", 1, "descriptor"),
        (ROBOT, "count", 2.0, "descriptor"),
        (ROBOT, "frame", "map", "descriptor"),
        (ROBOT, "gains", (1.0, "x"), "console"),
        (ROBOT, "nothing", 1.0, "node"),
        ("/nobody", "speed", 1.0, "node"),
    ],
)
def test_a_refusal_names_the_node_and_the_reason_and_changes_nothing(
    rig: Rig, node: str, name: str, value: Any, who: str
) -> None:
    before = rig.console.snapshot().parameters[ROBOT]
    (outcome,) = setting(rig, {name: value}, node)
    assert (outcome.node, outcome.name, outcome.value, outcome.accepted) == (node, name, value, False)
    assert outcome.refused_by == who
    assert outcome.reason
    (change,) = rig.console.parameters.changes()
    assert (change.name, change.new, change.accepted, change.reason) == (name, value, False, outcome.reason)
    assert change.answered is (who != "node")
    assert rig.console.snapshot().parameters[ROBOT] == before
    assert not rig.console.snapshot().journal.undoes


def test_the_reason_of_the_nodes_own_callback_is_reported_verbatim(rig: Rig) -> None:
    rig.forbid_speed()
    (outcome,) = setting(rig, {"speed": 1.5})
    assert (outcome.accepted, outcome.reason, outcome.refused_by) == (False, TOO_FAST, "callback")


def test_values_set_in_a_burst_are_undone_one_by_one(rig: Rig) -> None:
    values = 1.1, 1.2, 1.3
    for value in values:
        (outcome,) = setting(rig, {"speed": value})
        assert outcome.accepted
    setting(rig, {"speed": 1.3})  # it has this value already: neither a change nor something to undo
    for value in (1.2, 1.1, 1.0):
        assert rig.console.parameters.undo().result(TIMEOUT_S).ok
        wait_until_shown(rig, "speed", value)
    assert not rig.console.snapshot().journal.undoes
    until(lambda: len(rig.console.parameters.changes()) == 6, "the journal")
    assert [(each.old, each.new) for each in rig.console.parameters.changes()] == [
        *((1.0, 1.1), (1.1, 1.2), (1.2, 1.3)),
        *((1.3, 1.2), (1.2, 1.1), (1.1, 1.0)),
    ]


def test_undo_names_the_value_of_somebody_else_that_it_overwrites(rig: Rig) -> None:
    setting(rig, {"speed": 1.5})
    wait_until_shown(rig, "speed", 1.5)
    rig.set_elsewhere("speed", 1.75)
    wait_until_shown(rig, "speed", 1.75)
    undone = rig.console.parameters.undo().result(TIMEOUT_S)
    assert undone.ok and undone.text.endswith(f"had set meanwhile is overwritten: {ROBOT} speed = 1.75")
    wait_until_shown(rig, "speed", 1.0)
    redone = rig.console.parameters.redo().result(TIMEOUT_S)
    assert redone.ok and "overwritten" not in redone.text


def test_undo_passes_over_what_has_been_undone_elsewhere(rig: Rig) -> None:
    assert setting(rig, {"count": 4})[0].accepted
    assert setting(rig, {"speed": 1.5})[0].accepted
    wait_until_shown(rig, "speed", 1.5)
    rig.set_elsewhere("speed", 1.0)
    wait_until_shown(rig, "speed", 1.0)
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    wait_until_shown(rig, "count", 3)


def test_each_of_several_values_has_its_outcome(rig: Rig) -> None:
    outcomes = setting(rig, {"speed": 9.0, "count": 5})
    assert [(each.name, each.accepted) for each in outcomes] == [("speed", False), ("count", True)]
    wait_until_shown(rig, "count", 5)
    assert parameter(rig, "speed").value == 1.0


def test_atomic_set_accepts_all_values_or_none(rig: Rig) -> None:
    outcomes = setting(rig, {"speed": 9.0, "count": 5}, atomically=True)
    assert [each.accepted for each in outcomes] == [False, False]
    assert all(each.reason for each in outcomes)
    assert parameter(rig, "count").value == 3


def both(rig: Rig) -> tuple[object, object]:
    trees = rig.console.snapshot().parameters
    return parameter(rig, "speed").value, getattr(trees[ARM].get("reach"), "value", None)


def test_values_of_two_nodes_are_set_together_and_reverted_by_one_undo(rig: Rig) -> None:
    outcomes = rig.console.parameters.set_all(
        {ROBOT: {"speed": 0.5, "count": 4}, ARM: {"reach": 0.2}}, by="a set"
    ).result(TIMEOUT_S)
    assert len(outcomes) == 3 and all(each.accepted for each in outcomes)
    until(lambda: both(rig) == (0.5, 0.2), "the values of both nodes")
    until(lambda: len(rig.console.parameters.changes()) == 3, "the journal")
    assert {each.by for each in rig.console.parameters.changes()} == {"a set"}
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    until(lambda: both(rig) == (1.0, 1.0), "the values of both nodes")
    assert not rig.console.snapshot().journal.undoes


@pytest.mark.parametrize("rule", ["descriptor", "callback"])
def test_values_refused_by_one_node_are_set_on_none(rig: Rig, rule: str) -> None:
    """The robot is asked after the arm, in the order of the request; nobody knows its callback's rule in advance."""
    if rule == "callback":
        rig.forbid_speed()
    outcomes = rig.console.parameters.set_all(
        {ARM: {"reach": 0.2}, ROBOT: {"count": 4, "speed": 0.5 if rule == "callback" else 9.0}}
    ).result(TIMEOUT_S)
    assert not any(each.accepted for each in outcomes)
    (arm,) = (each for each in outcomes if each.node == ARM)
    assert arm.refused_by == "console" and f"{ROBOT} refused" in arm.reason
    refused = {each.name: each for each in outcomes if each.node == ROBOT}
    assert (TOO_FAST in refused["speed"].reason) is (rule == "callback")
    until(lambda: both(rig) == (1.0, 1.0), "the values before")
    assert parameter(rig, "count").value == 3
    snapshot = rig.console.snapshot()
    assert not snapshot.journal.undoes and snapshot.journal.unsaved == ()


def test_a_profile_refused_by_the_second_node_leaves_the_first_unchanged(rig: Rig) -> None:
    rig.forbid_speed()
    outcomes = rig.console.profiles.apply("careful").result(TIMEOUT_S)
    assert {each.node for each in outcomes} == {ARM, ROBOT} and not any(each.accepted for each in outcomes)
    until(lambda: both(rig) == (1.0, 1.0), "the values before")
    assert rig.console.snapshot().active_profile == ""
    assert not rig.console.snapshot().journal.undoes


def test_undo_and_redo_restore_values_and_say_which(rig: Rig) -> None:
    setting(rig, {"gains": (0.5, 0.25)})
    wait_until_shown(rig, "gains", (0.5, 0.25))
    for ask, value, source in (("undo", (1.0, 2.0), ChangeSource.UNDO), ("redo", (0.5, 0.25), ChangeSource.REDO)):
        answer = getattr(rig.console.parameters, ask)().result(TIMEOUT_S)
        assert answer == Answer(True, f"{ask}: {ROBOT} gains = [{value[0]}, {value[1]}]")
        wait_until_shown(rig, "gains", value)
        until(lambda source=source: rig.console.parameters.changes()[-1].source is source, "the journal")
        journal = rig.console.snapshot().journal
        assert (bool(journal.undoes), bool(journal.redoes)) == (ask == "redo", ask == "undo")


def test_a_new_change_discards_redoable_steps(rig: Rig) -> None:
    setting(rig, {"speed": 1.5})
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    setting(rig, {"count": 9})
    assert not rig.console.snapshot().journal.redoes
    assert not rig.console.parameters.redo().result(TIMEOUT_S).ok


@pytest.mark.parametrize("ask", ["undo", "redo"])
def test_undo_without_changes_is_refused(rig: Rig, ask: str) -> None:
    answer = getattr(rig.console.parameters, ask)().result(TIMEOUT_S)
    assert not answer.ok and f"nothing to {ask}" in answer.text


def test_a_change_made_elsewhere_is_shown_and_cannot_be_undone_here(rig: Rig) -> None:
    rig.set_elsewhere("mode", "brave")
    wait_until_shown(rig, "mode", "brave")
    until(rig.console.parameters.changes, "the journal")
    assert rig.console.parameters.changes()[-1].source is ChangeSource.OTHER
    assert not rig.console.snapshot().journal.undoes


def test_the_origin_of_a_value_says_who_has_set_it(rig: Rig) -> None:
    assert parameter(rig, "speed").origin == "start value"
    setting(rig, {"speed": 0.5})
    wait_until_shown(rig, "speed", 0.5)
    assert parameter(rig, "speed").origin.startswith("set here at ")
    rig.set_elsewhere("mode", "brave")
    wait_until_shown(rig, "mode", "brave")
    assert parameter(rig, "mode").origin.startswith("set by another program or the node at ")


def test_the_journal_is_read_from_a_number_on(rig: Rig) -> None:
    for value in (1, 2, 4):
        setting(rig, {"count": value})
    until(lambda: len(rig.console.parameters.changes()) == 3, "three entries")
    assert [each.seq for each in rig.console.parameters.changes()] == [0, 1, 2]
    assert [each.new for each in rig.console.parameters.changes(2)] == [4]
    assert (rig.console.snapshot().journal.first, rig.console.snapshot().journal.end) == (0, 3)


def test_a_profile_shows_what_it_would_change(rig: Rig) -> None:
    profiles = {each.name: each for each in rig.console.snapshot().profiles}
    assert list(profiles) == ["broken", "careful", "elsewhere", "slow", "wild"]
    assert "two underscores" in profiles["broken"].problem
    assert profiles["slow"].title == "Slow: for crowded rooms."
    found = {each.name: each for each in rig.console.profiles.differences("slow")}
    assert (found["speed"].now, found["speed"].then, found["speed"].refusal) == (1.0, 0.2, "")
    assert {each.name: bool(each.refusal) for each in rig.console.profiles.differences("wild")} == {
        "speed": True,
        "count": False,
    }
    assert not rig.console.profiles.differences("nobody")
    with pytest.raises(ValueError, match="none of its nodes is running"):
        rig.console.profiles.apply("elsewhere").result(TIMEOUT_S)
    assert rig.console.snapshot().active_profile == "", "a profile that no node accepted is not active"


def test_a_profile_is_applied_and_can_be_undone(rig: Rig) -> None:
    outcomes = rig.console.profiles.apply("slow").result(TIMEOUT_S)
    assert {each.name: each.accepted for each in outcomes} == {"speed": True, "count": True}
    wait_until_shown(rig, "speed", 0.2)
    until(lambda: rig.console.snapshot().active_profile == "slow", "the active profile")
    assert not rig.console.profiles.differences("slow")
    assert {each.source for each in rig.console.parameters.changes()} == {ChangeSource.PROFILE}
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    wait_until_shown(rig, "speed", 1.0)
    wait_until_shown(rig, "count", 3)


def test_one_undo_reverts_a_profile_and_its_name_on_all_nodes(rig: Rig) -> None:
    def named(name: str, changes: int) -> None:
        until(
            lambda: (rig.console.snapshot().active_profile, rig.console.snapshot().profile_changes) == (name, changes),
            f"{name}, {changes} changed",
        )

    def values() -> tuple[object, object]:
        trees = rig.console.snapshot().parameters
        return tuple(getattr(trees[node].get(name), "value", None) for node, name in ((ROBOT, "speed"), (ARM, "reach")))

    rig.console.profiles.apply("slow").result(TIMEOUT_S)
    named("slow", 0)
    setting(rig, {"count": 7})
    named("slow", 1)
    rig.console.profiles.apply("careful").result(TIMEOUT_S)
    named("careful", 0)
    assert values() == (0.5, 0.3)
    answer = rig.console.parameters.undo().result(TIMEOUT_S)
    assert answer.ok
    until(lambda: values() == (0.2, 1.0), "the values of both nodes")
    named("slow", 1)
    assert rig.console.parameters.redo().result(TIMEOUT_S).ok
    until(lambda: values() == (0.5, 0.3), "the values of both nodes")
    named("careful", 0)


def test_an_undo_refused_by_one_node_is_reported_and_the_profile_stays_active(rig: Rig) -> None:
    rig.console.profiles.apply("careful").result(TIMEOUT_S)
    wait_until_shown(rig, "speed", 0.5)
    rig.forbid_speed()
    answer = rig.console.parameters.undo().result(TIMEOUT_S)
    assert not answer.ok and TOO_FAST in answer.text
    until(lambda: rig.console.snapshot().profile_changes == 1, "the arm's value")
    snapshot = rig.console.snapshot()
    assert snapshot.active_profile == "careful"
    assert (bool(snapshot.journal.undoes), bool(snapshot.journal.redoes)) == (True, True)
    assert parameter(rig, "speed").value == 0.5


def test_values_set_here_are_unsaved_until_saved_or_undone(rig: Rig, tmp_path: Path) -> None:
    def unsaved() -> tuple[tuple[str, str], ...]:
        return rig.console.snapshot().journal.unsaved

    assert unsaved() == ()
    setting(rig, {"speed": 1.5, "count": 9})
    assert unsaved() == ((ROBOT, "count"), (ROBOT, "speed"))
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    assert unsaved() == ()
    rig.console.profiles.apply("careful").result(TIMEOUT_S)
    rig.set_elsewhere("mode", "brave")
    wait_until_shown(rig, "mode", "brave")
    assert unsaved() == ()
    setting(rig, {"count": 9})
    assert rig.console.parameters.save(str(tmp_path / "arm.yaml"), [ARM]).ok
    assert unsaved() == ((ROBOT, "count"),)
    assert rig.console.parameters.save(str(tmp_path / "all.yaml")).ok
    assert unsaved() == ()
    assert rig.console.parameters.undo().result(TIMEOUT_S).ok
    assert unsaved() == ()


def test_a_refused_profile_changes_nothing_and_does_not_become_active(rig: Rig) -> None:
    outcomes = rig.console.profiles.apply("wild").result(TIMEOUT_S)
    assert not any(each.accepted for each in outcomes)
    assert parameter(rig, "count").value == 3
    assert rig.console.snapshot().active_profile == ""


@pytest.mark.parametrize(("name", "why"), [("nobody", "no profile nobody"), ("broken", "two underscores")])
def test_an_unusable_profile_is_explained(rig: Rig, name: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        rig.console.profiles.apply(name).result(TIMEOUT_S)


def test_saving_parameters_succeeds_or_says_why_not(rig: Rig, tmp_path: Path) -> None:
    answer = rig.console.parameters.save(str(tmp_path / "saved.yaml"), [ROBOT])
    assert answer.ok and "saved" in answer.text
    assert "speed: 1.0" in (tmp_path / "saved.yaml").read_text()
    answer = rig.console.parameters.save(str(tmp_path / "saved.yaml" / "below.yaml"))
    assert not answer.ok and answer.text


def test_any_file_can_be_opened_as_a_profile_and_previewed(rig: Rig, tmp_path: Path) -> None:
    file = tmp_path / "mine" / "any.yaml"
    file.parent.mkdir()
    file.write_text("# Mine.\n/**:\n  ros__parameters: {speed: 0.4}\n/robot:\n  ros__parameters: {nobody: 1}\n")
    answer = rig.console.profiles.open(str(file))
    assert (answer.ok, answer.text) == (True, "any")
    found = {(each.node, each.name): each for each in rig.console.profiles.differences("any")}
    assert set(found) == {(ROBOT, "speed"), (ROBOT, "nobody")}, (
        "a wildcard does not ask nodes for parameters that they lack"
    )
    assert found[ROBOT, "nobody"].unknown and not found[ROBOT, "speed"].refusal
    outcomes = rig.console.profiles.apply("any").result(TIMEOUT_S)
    assert [(each.name, each.accepted) for each in outcomes] == [("speed", True)]
    answer = rig.console.profiles.open(str(tmp_path / "nowhere.yaml"))
    assert not answer.ok and "no file" in answer.text


def test_current_values_are_saved_as_a_profile_and_can_be_restored(rig: Rig) -> None:
    setting(rig, {"speed": 1.5})
    wait_until_shown(rig, "speed", 1.5)
    assert rig.console.profiles.save("fast", "For the long hall.").ok
    saved = next(each for each in rig.console.snapshot().profiles if each.name == "fast")
    assert saved.title == "For the long hall." and saved.values[ROBOT, "speed"] == 1.5
    assert rig.console.snapshot().journal.unsaved == ()
    setting(rig, {"speed": 0.5})
    wait_until_shown(rig, "speed", 0.5)
    found = {each.name: each.then for each in rig.console.profiles.differences("fast") if not each.refusal}
    assert found == {"speed": 1.5}
    assert rig.console.profiles.rename("fast", "faster").ok
    assert [each.name for each in rig.console.snapshot().profiles if each.own] == ["faster"]
    assert rig.console.profiles.delete("faster").ok and not rig.console.profiles.delete("faster").ok
    assert not any(each.own for each in rig.console.snapshot().profiles)


def test_a_profile_whose_file_is_deleted_is_no_longer_active(rig: Rig) -> None:
    assert rig.console.profiles.save("passing").ok
    assert all(each.accepted for each in rig.console.profiles.apply("passing").result(TIMEOUT_S))
    assert rig.console.snapshot().active_profile == "passing"
    assert rig.console.profiles.delete("passing").ok
    snapshot = rig.console.snapshot()
    assert (snapshot.active_profile, snapshot.profile_changes) == ("", 0)
