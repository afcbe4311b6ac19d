"""Values typed as YAML on which the YAML library itself fails."""

from __future__ import annotations

import pytest
from bot_console.tui.console.topics.typed import parse
from ros2cli.yaml_values import read_values


@pytest.mark.parametrize("source", ["!!int", "!!float", "!!timestamp x", "[" * 1000])
def test_yaml_library_errors_are_reported_on_one_line(source):
    with pytest.raises((RuntimeError, ValueError), match="not valid YAML"):
        read_values(source)


@pytest.mark.parametrize("words", ["!!int", "!!timestamp x"])
def test_invalid_field_is_rejected_with_an_example(words):
    with pytest.raises(ValueError, match="write it as in YAML"):
        parse("geometry_msgs/Point", words)


def test_too_large_number_is_rejected():
    with pytest.raises(ValueError, match="geometry_msgs/Point: int too large"):
        parse("geometry_msgs/Point", f"{{x: {'9' * 400}}}")
