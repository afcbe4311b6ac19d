"""Going back to a row restores the values that its run had set by then, and guesses nothing."""

from __future__ import annotations

from bot_console.tui.console.model import Change, ChangeSource, Kind, ParameterInfo, ParameterTree, Value
from bot_console.tui.panes.history.revert import Restoration, restorations, values_at


def change(seq: int, name: str, old: Value, new: Value, *, accepted: bool = True, run: int = 0) -> Change:
    return Change(seq, seq, "/n", name, old, new, ChangeSource.EDIT, accepted, run=run)


CHANGES = [
    change(0, "speed", 1.0, 2.0),
    change(1, "gain", 5, 6),
    change(2, "speed", 2.0, 9.0, accepted=False),
    change(3, "speed", 2.0, 3.0),
    change(4, "mode", "calm", "brave"),
]


def test_values_at_a_moment_are_the_newest_accepted_ones() -> None:
    assert values_at(CHANGES, CHANGES[2]) == {("/n", "speed"): 2.0, ("/n", "gain"): 6, ("/n", "mode"): "calm"}
    assert values_at(CHANGES, CHANGES[0]) == {("/n", "speed"): 2.0, ("/n", "gain"): 5, ("/n", "mode"): "calm"}


def test_values_of_other_runs_are_ignored() -> None:
    earlier = [change(-2, "speed", 1.0, 7.0, run=5), change(-1, "gain", 5, 8, run=5)]
    assert values_at([*earlier, *CHANGES], CHANGES[1]) == values_at(CHANGES, CHANGES[1])
    assert values_at([*earlier, *CHANGES], earlier[0]) == {("/n", "speed"): 7.0, ("/n", "gain"): 5}


def test_only_differing_values_are_set_and_missing_ones_reported() -> None:
    tree = ParameterTree(
        "/n",
        (
            ParameterInfo("/n", "speed", Kind.DOUBLE, 3.0),
            ParameterInfo("/n", "gain", Kind.INTEGER, 6),
            ParameterInfo("/n", "frame", Kind.STRING, "a", read_only=True),
        ),
    )
    then: dict[tuple[str, str], Value] = {
        **{("/n", "speed"): 2.0, ("/n", "gain"): 6, ("/n", "mode"): "calm"},
        **{("/n", "frame"): "b", ("/gone", "x"): 1},
    }
    found, missing = restorations(then, {"/n": tree})
    assert found == [Restoration("/n", "speed", 3.0, 2.0)]
    assert missing == ["/gone x: node not running", "/n mode: the parameter no longer exists"]
