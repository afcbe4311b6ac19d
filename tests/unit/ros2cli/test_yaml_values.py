"""Values that a person types as YAML, where the library fails in its own ways."""

from __future__ import annotations

import pytest
from bot_console.tui.console.topics.typed import parse
from ros2cli.yaml_values import read_values


@pytest.mark.parametrize("source", ["!!int", "!!float", "!!timestamp x", "[" * 1000])
def test_what_the_library_lets_fall_is_reported_on_one_line(source):
    with pytest.raises((RuntimeError, ValueError), match="no YAML"):
        read_values(source)


@pytest.mark.parametrize("words", ["!!int", "!!timestamp x"])
def test_a_field_is_refused_with_an_example(words):
    with pytest.raises(ValueError, match="write it as in YAML"):
        parse("geometry_msgs/Point", words)


def test_a_number_that_no_field_can_hold_is_refused():
    with pytest.raises(ValueError, match="geometry_msgs/Point: int too large"):
        parse("geometry_msgs/Point", f"{{x: {'9' * 400}}}")
