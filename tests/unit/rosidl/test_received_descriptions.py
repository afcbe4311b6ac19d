"""Descriptions made from definition files alone have the same hashes as the generated classes."""

from __future__ import annotations

import importlib

import pytest
from bot_console.runtime.rosidl.parse import DefinitionError
from bot_console.runtime.rosidl.received_descriptions import describe_texts
from bot_console.runtime.rosidl.texts import definition_text, interface_names
from bot_console.runtime.rosidl.type_description import describe
from bot_console.runtime.rosidl.type_hash import text, text_of_description

PACKAGES = (
    "action_tutorials_interfaces",
    "example_interfaces",
    "geometry_msgs",
    "nav2_msgs",
    "rcl_interfaces",
    "std_msgs",
    "std_srvs",
    "type_description_interfaces",
)


@pytest.mark.parametrize(
    "package", [pytest.param(each, marks=pytest.mark.slow) if each == "nav2_msgs" else each for each in PACKAGES]
)
def test_hash_of_the_texts_is_that_of_the_class(package: str) -> None:
    names = interface_names(package)
    assert names
    for name in names:
        kind, short = name.split("/")
        cls = getattr(importlib.import_module(f"{package}.{kind}"), short)
        reported = describe(cls)
        parts = [reported["type_description"], *reported["referenced_type_descriptions"]]
        texts = {each["type_name"]: definition_text(*each["type_name"].split("/")) for each in parts}
        described = describe_texts(
            f"{package}/{name}", {part: text for part, text in texts.items() if text is not None}
        )
        assert text_of_description(described) == text(cls), name


def test_missing_definition_of_a_nested_type_is_rejected() -> None:
    with pytest.raises(DefinitionError, match="the definition of geometry_msgs/msg/Vector3 is missing"):
        describe_texts("my/msg/Speed", {"my/msg/Speed": "geometry_msgs/Vector3 linear\n"})
