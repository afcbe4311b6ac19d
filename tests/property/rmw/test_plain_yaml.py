"""Scalars that are read without the YAML library have the same value as with it."""

from __future__ import annotations

import yaml
from bot_console.runtime.rmw.plain_yaml import plain_scalar
from hypothesis import example, given
from hypothesis import strategies as st

WORDS = ("yes", "No", "TRUE", "False", "on", "OFF", "y", "null", "Null", "nan", "inf", "e", "yEs", "nULL", "true_")


@given(
    st.one_of(
        st.from_regex(r"[-+]?[0-9_.]{1,12}\n?", fullmatch=True),
        st.from_regex(r"[-+]?[0-9]{1,4}(\.[0-9]*)?(e[-+]?[0-9]{1,2})?", fullmatch=True),
        st.text(alphabet="aeYnN_0.~ :#'[-\n", max_size=6),
        st.sampled_from(WORDS),
    )
)
@example("10.0")
@example("010")
@example("٣")
def test_a_plain_scalar_has_its_yaml_value(text: str) -> None:
    seen = plain_scalar(text)
    if seen is not None:
        expected = yaml.safe_load(text)
        assert (seen, type(seen)) == (expected, type(expected))


def test_common_values_are_plain() -> None:
    typed = ("1.0", "-3", "0", "true", "False", "on", "Scout", "robot_name", "YES")
    assert [plain_scalar(each) for each in typed] == [1.0, -3, 0, True, False, True, "Scout", "robot_name", True]
