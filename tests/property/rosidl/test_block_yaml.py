"""YAML written without the library is identical to the library's."""

from __future__ import annotations

import sys
from typing import Any

import yaml
from hypothesis import given
from hypothesis import strategies as st
from rosidl_runtime_py.block_yaml import block_yaml

WORDS = [
    "",
    "y",
    "no",
    "On",
    "null",
    "e5",
    "tick 1",
    "a_b",
    " a",
    "a ",
    "a  b",
    "1",
    "1e3",
    "0x1",
    "inf",
    "-",
    "é",
    "a:",
]
texts = st.sampled_from(WORDS) | st.text()
scalars = st.booleans() | st.integers() | st.floats() | st.sampled_from([1e300, 1e16, 5e-7]) | texts
leaves = scalars | st.lists(scalars, max_size=3)
names = st.sampled_from(["x", "y", "n", "no", "on", "frame_id", "a1"])
values = st.recursive(leaves, lambda inside: st.dictionaries(names, inside, max_size=3))


def library(fields: dict[str, Any]) -> str:
    return yaml.dump(fields, allow_unicode=True, width=sys.maxsize, default_flow_style=False, sort_keys=False)


@given(st.dictionaries(names, values, max_size=4))
def test_output_is_identical_to_the_librarys(fields: dict[str, Any]) -> None:
    assert block_yaml(fields) in (None, library(fields))


def test_ambiguous_texts_are_left_to_the_library() -> None:
    for word in WORDS:
        assert block_yaml({"a": word}) in (None, library({"a": word}))


def test_common_fields_need_no_library() -> None:
    fields = {"header": {"stamp": {"sec": 1}, "frame_id": ""}, "ranges": [1.0, float("inf")], "ok": True, "name": "a b"}
    assert block_yaml(fields) == (
        "header:\n  stamp:\n    sec: 1\n  frame_id: ''\nranges:\n- 1.0\n- .inf\nok: true\nname: a b\n"
    )
