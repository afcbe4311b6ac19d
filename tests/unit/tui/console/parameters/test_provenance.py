"""Where a value comes from: the declaration, the launch file, the command line, a profile, or unknown."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, Value
from bot_console.tui.console.parameters.origin_text import START
from bot_console.tui.console.parameters.provenance import Provenance

PROFILES = {"/profiles/indoor.yaml": "indoor"}


def first_snapshot(value: Value = 2.0) -> ParameterInfo:
    return ParameterInfo("/n", "speed", Kind.DOUBLE, value, default=value, origin=START)


def origin_of(override: str, given: str = "", value: Value = 2.0) -> ParameterInfo:
    provenance = Provenance(lambda path: PROFILES.get(path, ""))
    if given:
        assert provenance.learn("given", {"node": "/n", "parameters": {"speed": given}}) == "/n"
    declared = ["speed", 1.0, "/ws/src/n.py:12", override]
    assert provenance.learn("declared", {"node": "/n", "parameters": [declared]}) == "/n"
    return provenance.applied(first_snapshot(value))


@pytest.mark.parametrize(
    ("override", "given", "value", "origin"),
    [
        ("", "", 1.0, "declared value"),
        ("", "", 2.0, START),
        ("-p", "", 2.0, "command line"),
        ("-p", "launch file a.launch.py:3", 2.0, "launch file a.launch.py:3"),
        ("/tmp/launch_params_x1", "launch argument speed", 2.0, "launch argument speed"),
        ("/tmp/launch_params_x1", "", 2.0, "launch file"),
        ("/profiles/indoor.yaml", "", 2.0, "profile indoor"),
        ("/home/a/mine.yaml", "launch argument speed", 2.0, "parameter file /home/a/mine.yaml"),
        ("parameter_overrides of its program", "", 2.0, "parameter_overrides of its program"),
    ],
)
def test_the_override_that_takes_effect_is_named_as_origin(
    override: str, given: str, value: Value, origin: str
) -> None:
    found = origin_of(override, given, value)
    assert found.origin == origin
    assert (found.default, found.declared_at) == (1.0, "/ws/src/n.py:12")
    assert found.changed is (value != 1.0), "a mark shows values that differ from the declared ones"


def test_start_values_are_known_if_they_were_reported() -> None:
    provenance = Provenance()
    facts = [["speed", 1.0, "/n.py:1", "-p", 2.0], ["gains", [1.0], "/n.py:2", "", [1.0, 2.0]], ["old", 1, "", ""]]
    provenance.learn("declared", {"node": "/n", "parameters": facts})
    assert provenance.starts() == {("/n", "speed"): 2.0, ("/n", "gains"): (1.0, 2.0)}


def test_a_value_set_before_the_console_saw_it_does_not_come_from_what_the_node_started_with() -> None:
    provenance = Provenance(lambda path: PROFILES.get(path, ""))
    declared = ["speed", 1.0, "/n.py:1", "/profiles/indoor.yaml", 2.0]
    provenance.learn("declared", {"node": "/n", "parameters": [declared]})
    assert provenance.applied(first_snapshot(2.0)).origin == "profile indoor"
    assert provenance.applied(first_snapshot(3.0)).origin == "set by another program or the node since the start"


def test_an_unreported_value_stays_a_start_value() -> None:
    assert Provenance().applied(first_snapshot()) == first_snapshot()
    assert Provenance().learn("notice", {"text": "x"}) == ""


def test_a_later_set_remains_the_origin() -> None:
    provenance = Provenance()
    provenance.learn("declared", {"node": "/n", "parameters": [["speed", 1.0, "/n.py:1", "-p"]]})
    known = ParameterInfo("/n", "speed", Kind.DOUBLE, 3.0, default=2.0, origin="set here at 10:00:00")
    found = provenance.applied(known)
    assert found.origin == "set here at 10:00:00" and found.default == 1.0


def test_a_declared_list_becomes_a_tuple_and_a_type_is_not_a_default() -> None:
    provenance = Provenance()
    facts = [["speed", None, "/n.py:1", ""], ["list", [1, 2], "/n.py:2", ""]]
    provenance.learn("declared", {"node": "/n", "parameters": facts})
    assert provenance.applied(first_snapshot()).default == 2.0
    array = ParameterInfo("/n", "list", Kind.INTEGER_ARRAY, (1, 2), default=(1, 2), origin=START)
    assert provenance.applied(array).origin == "declared value"


def test_declared_bytes_are_kept_as_bytes() -> None:
    provenance = Provenance()
    provenance.learn("declared", {"node": "/n", "parameters": [["raw", [{"byte": 1}, {"byte": 255}], "/n.py:1", ""]]})
    raw = ParameterInfo("/n", "raw", Kind.BYTE_ARRAY, (b"\x01", b"\xff"), default=(b"\x01", b"\xff"), origin=START)
    assert provenance.applied(raw).origin == "declared value"
