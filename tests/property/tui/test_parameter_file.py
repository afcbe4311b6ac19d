"""Parameter files: written values are read back by us, by YAML and by ROS; patching loses nothing."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import pytest
import yaml
from bot_console.runtime.rmw.parameter_precedence import ParameterTable
from bot_console.runtime.rmw.parameter_scalars import scalar_value
from bot_console.tui.console.model import Value
from bot_console.tui.console.parameters.file.patch import new_text, patched, same
from bot_console.tui.console.parameters.file.text import plain_value, sections, value_at
from hypothesis import example, given
from hypothesis import strategies as st

TEXTS = st.one_of(
    st.text(st.characters(codec="utf-8", exclude_categories=["Cs"], exclude_characters="\0"), max_size=12),
    st.sampled_from(
        ["", "yes", "1", "1e3", "null", "~", "a: b", "- a", "#", "'", '"', "2020-01-01", "1:30", "\n", "=", "<<"]
    ),
)
SCALARS = (st.booleans(), st.integers(-(2**63), 2**63 - 1), st.floats(allow_nan=False, allow_subnormal=False), TEXTS)
VALUES: st.SearchStrategy[Value] = st.one_of(
    *SCALARS, *(st.lists(each, min_size=1, max_size=4).map(tuple) for each in SCALARS)
)
NAMES = st.one_of(
    st.text("ab_.1", min_size=1, max_size=6).filter(lambda name: ".." not in name and name.strip(".") == name),
    st.sampled_from(["yes", "a-b", "1", "max speed", "größe"]),
)
PARAMETERS = st.dictionaries(NAMES, VALUES, min_size=1, max_size=5)


def read_by_us(text: str) -> dict[tuple[str, str], Value]:
    return {(one.key, name): value_at(name, at) for one in sections(text) for name, at in one.places.items()}


def read_by_ros(text: str, node: str) -> dict[str, Value]:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "file.yaml"
        path.write_text(text, encoding="utf-8", newline="")
        table = ParameterTable()
        table.add_file(str(path))
    found = table.for_node(node)
    return {name: tuple(value) if isinstance(value, list) else value for name, value in found.items()}


def flat(data: dict[str, object], prefix: str = "") -> dict[str, object]:
    found: dict[str, object] = {}
    for name, value in data.items():
        found.update(flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {prefix + name: value})  # type: ignore[arg-type]
    return found


def assert_given(text: str, node: str, values: dict[str, Value]) -> None:
    """Check that every reader of parameter files gives a node these values."""
    ours = {name: value for (key, name), value in read_by_us(text).items() if key == node}
    upstream = flat(yaml.safe_load(text)[node]["ros__parameters"])
    by_yaml = {name: tuple(value) if isinstance(value, list) else value for name, value in upstream.items()}
    for found in (ours, by_yaml, read_by_ros(text, node)):
        assert found.keys() == values.keys()
        for name, value in values.items():
            assert same(found[name], value), (name, found[name], value)  # type: ignore[arg-type]


@given(PARAMETERS)
@example({"a": 1, "a.b": 2, "a.b.c": (1.0, 2.0)})
@example({"x": 2.0**-1022, "y": 1e16, "z": -0.0})
def test_ros_reads_written_values_back(values: dict[str, Value]) -> None:
    assert_given(new_text({"/n": values}), "/n", values)


@given(PARAMETERS, PARAMETERS, st.sampled_from(["\n", "\r\n"]))
def test_patching_sets_the_new_values_and_keeps_the_others(
    old: dict[str, Value], new: dict[str, Value], newline: str
) -> None:
    text = "# mine\n" + new_text({"/n": old, "/other": old}) + "# the end\n"
    try:
        result = patched(text.replace("\n", newline), {"/n": new})
    except ValueError:
        # A name that is a map in the file cannot hold a value as well.
        names = {*old, *new}
        assert any(other.startswith(f"{name}.") for name in names for other in names)
        return
    assert result.startswith("# mine" + newline) and result.endswith("# the end" + newline)
    assert_given(result, "/n", {**old, **new})
    assert_given(result, "/other", old)


SCRAPS = [
    "0",
    "1",
    "7",
    "9",
    "x",
    "e",
    "E",
    ".",
    "+",
    "-",
    "_",
    ":",
    "inf",
    "nan",
    "Inf",
    "y",
    "no",
    "true",
    "~",
    "f",
    "null",
]


@given(st.lists(st.sampled_from(SCRAPS), min_size=1, max_size=6).map("".join))
def test_scalars_have_the_same_value_as_in_ros(text: str) -> None:
    ours, theirs = plain_value(text), scalar_value(text)
    # Only C understands hexadecimal fractions and signed words for NaN, and nobody writes them.
    assert same(ours, theirs) or (isinstance(theirs, float) and "x" in text)


@pytest.mark.parametrize("before", ["", "0x"])
@pytest.mark.parametrize("read", [plain_value, scalar_value])
def test_a_number_with_very_many_digits_is_read_quickly(read, before):
    text = before + "1" * 30_000 + "z"
    began = process_time()
    assert read(text) == text
    assert process_time() - began < 5, "the time grows with the square of the digits: 40 s"
