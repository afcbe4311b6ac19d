"""Validation, expansion and remapping of names are consistent for all names."""

from __future__ import annotations

import string

from bot_console.runtime.rmw import names, remapping
from hypothesis import given
from hypothesis import strategies as st

INITIALS = f"{string.ascii_letters}_"
tokens = st.builds(str.__add__, st.sampled_from(INITIALS), st.text(INITIALS + string.digits, max_size=7))
paths = st.lists(tokens, min_size=1, max_size=4).map("/".join)
namespaces = st.one_of(st.just("/"), paths.map(lambda path: f"/{path}"))
typed = st.one_of(
    paths,
    paths.map(lambda path: f"/{path}"),
    st.just("~"),
    paths.map(lambda path: f"~/{path}"),
    st.tuples(st.sampled_from(["{node}", "{ns}/x", "{namespace}/x"]), paths).map("/".join),
)
anything = st.text(alphabet="aZ_09/~{}- .\n", max_size=12)


@given(typed, tokens, namespaces)
def test_a_valid_name_expands_to_a_full_name(name: str, node: str, namespace: str) -> None:
    assert names.validate_topic_name(name) is None
    full = names.expand(name, node, namespace)
    if "{ns}" in name or "{namespace}" in name:
        full = full.replace("//", "/")  # the root namespace ends with a slash itself
    assert names.validate_full_topic_name(full) is None


@given(typed, tokens, namespaces)
def test_expansion_does_not_change_a_full_name(name: str, node: str, namespace: str) -> None:
    full = names.expand(name, node, namespace)
    assert names.expand(full, node, namespace) == full


@given(paths, tokens, namespaces)
def test_relative_and_private_names_expand_below_namespace_and_node(path: str, node: str, namespace: str) -> None:
    prefix = namespace.rstrip("/")
    assert names.expand(path, node, namespace) == f"{prefix}/{path}"
    assert names.expand(f"~/{path}", node, namespace) == f"{prefix}/{node}/{path}"
    assert names.expand(f"/{path}", node, namespace) == f"/{path}"


@given(anything)
def test_the_position_of_a_fault_is_within_the_name(name: str) -> None:
    for validate in (
        names.validate_node_name,
        names.validate_namespace,
        names.validate_topic_name,
        names.validate_full_topic_name,
    ):
        problem = validate(name)
        assert problem is None or 0 <= problem[1] < max(1, len(name))


@given(anything)
def test_names_valid_when_expanded_are_valid_as_typed(name: str) -> None:
    if names.validate_full_topic_name(name) is None:
        assert names.validate_topic_name(name) is None
        assert names.validate_namespace(name) is None


@given(anything)
def test_node_names_are_single_tokens(name: str) -> None:
    if names.validate_node_name(name) is None:
        assert names.validate_topic_name(name) is None
        assert names.expand(name, "n", "/") == f"/{name}"


sides = st.one_of(paths, paths.map(lambda path: f"/{path}"), paths.map(lambda path: f"~/{path}"))
schemes = st.sampled_from(["", "rostopic://", "rosservice://"])
rules = st.tuples(st.one_of(st.none(), tokens), schemes, sides, sides)


def text_of(rule: tuple[str | None, str, str, str]) -> str:
    node, scheme, match, replacement = rule
    prefix = "" if node is None else f"{node}:"
    return f"{prefix}{scheme}{match}:={replacement}"


@given(rules)
def test_a_rule_is_parsed_as_written(rule: tuple[str | None, str, str, str]) -> None:
    node, scheme, match, replacement = rule
    found = remapping.parse_rule(text_of(rule))
    assert (found.node, found.match, found.replacement) == (node, match, replacement)
    assert bool(found.kind & remapping.Kind.TOPIC) == (scheme != "rosservice://")
    assert bool(found.kind & remapping.Kind.SERVICE) == (scheme != "rostopic://")


@given(st.lists(rules, max_size=6), sides, tokens, namespaces)
def test_only_the_first_matching_rule_applies(
    written: list[tuple[str | None, str, str, str]], name: str, node: str, namespace: str
) -> None:
    full = names.expand(name, node, namespace)
    expected = full
    for owner, scheme, match, replacement in reversed(written):
        if owner in (None, node) and scheme != "rosservice://" and names.expand(match, node, namespace) == full:
            expected = names.expand(replacement, node, namespace)
    parsed = [remapping.parse_rule(text_of(rule)) for rule in written]
    assert remapping.remap_topic(parsed, node, namespace, full) == expected


@given(st.text(alphabet="ab_1/~:={}*\\ .", max_size=14))
def test_no_text_breaks_the_parser(text: str) -> None:
    try:
        remapping.parse_rule(text)
    except remapping.GrammarError as error:
        assert str(error)
