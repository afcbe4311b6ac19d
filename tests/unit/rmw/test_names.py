"""Names: validity, expansion and hidden names; error messages and positions are those of rcl and rmw."""

from __future__ import annotations

import pytest
from bot_console.runtime.rmw import names

UNALLOWED = "must not contain characters other than alphanumerics"


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("n", None),
        ("_n1", None),
        ("A" * 255, None),
        ("", ("node name must not be empty", 0)),
        ("a-b", (f"node name {UNALLOWED} or '_'", 1)),
        ("a/b", (f"node name {UNALLOWED} or '_'", 1)),
        ("ab\n", (f"node name {UNALLOWED} or '_'", 2)),
        ("é", (f"node name {UNALLOWED} or '_'", 0)),
        ("1n", ("node name must not start with a number", 0)),
        ("a" * 256, ("node name length should not exceed '255'", 254)),
    ],
)
def test_node_names_are_validated(name: str, problem: tuple[str, int] | None) -> None:
    assert names.validate_node_name(name) == problem


@pytest.mark.parametrize(
    ("namespace", "problem"),
    [
        ("/", None),
        ("/a", None),
        ("/a/b_1", None),
        ("/" + "a" * 244, None),
        ("", ("namespace must not be empty", 0)),
        ("a", ("namespace must be absolute, it must lead with a '/'", 0)),
        ("/a/", ("namespace must not end with a '/', unless only a '/'", 2)),
        ("/a b", (f"namespace {UNALLOWED}, '_', or '/'", 2)),
        ("/~a", (f"namespace {UNALLOWED}, '_', or '/'", 1)),
        ("/a//b", ("namespace must not contain repeated '/'", 3)),
        ("/a/1b", ("namespace must not have a token that starts with a number", 3)),
        ("/" + "a" * 245, ("namespace should not exceed 'RMW_NAMESPACE_MAX_NAME_LENGTH'", 244)),
    ],
)
def test_namespaces_are_validated(namespace: str, problem: tuple[str, int] | None) -> None:
    assert names.validate_namespace(namespace) == problem


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("/a", None),
        ("/a/_b/C1", None),
        ("/" + "a" * 246, None),
        ("", ("topic name must not be empty", 0)),
        ("a", ("topic name must be absolute, it must lead with a '/'", 0)),
        ("/", ("topic name must not end with a '/'", 0)),
        ("/a/", ("topic name must not end with a '/'", 2)),
        ("/é/", ("topic name must not end with a '/'", 3)),
        ("/a-b", (f"topic name {UNALLOWED}, '_', or '/'", 2)),
        ("/~/a", (f"topic name {UNALLOWED}, '_', or '/'", 1)),
        ("//a", ("topic name must not contain repeated '/'", 1)),
        ("/1a", ("topic name must not have a token that starts with a number", 1)),
        ("/" + "a" * 247, ("topic length should not exceed '255U - 8U'", 246)),
    ],
)
def test_full_topic_names_are_validated(name: str, problem: tuple[str, int] | None) -> None:
    assert names.validate_full_topic_name(name) == problem


TYPED = f"topic name {UNALLOWED}, '_', '~', '{{', or '}}'"
BRACES = "topic name must not have unmatched (unbalanced) curly braces '{}'"


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("chatter", None),
        ("/abs/olute", None),
        ("~/private", None),
        ("~", None),
        ("~a", None),
        ("~ab", ("topic name must not have a tilde '~' that is not followed by a forward slash '/'", 1)),
        ("{node}/x", None),
        ("a{ns}b", None),
        ("{}", None),
        ("a//b", None),
        ("", ("topic name must not be empty string", 0)),
        ("1a", ("topic name token must not start with a number", 0)),
        ("a/1b", ("topic name token must not start with a number", 2)),
        ("a/", ("topic name must not end with a forward slash", 1)),
        ("é/", ("topic name must not end with a forward slash", 2)),
        ("/", ("topic name must not end with a forward slash", 0)),
        ("a b", (TYPED, 1)),
        ("a.b", (TYPED, 1)),
        ("a/~", ("topic name must not have tilde '~' unless it is the first character", 2)),
        ("{a", (BRACES, 0)),
        ("a}", (BRACES, 1)),
        ("{a}}", (BRACES, 3)),
        ("{~}", ("topic name must not have tilde '~' unless it is the first character", 1)),
        (
            "{a-b}",
            ("substitution name must not contain characters other than alphanumerics or '_'", 2),
        ),
        ("{1a}", ("substitution name must not start with a number", 1)),
    ],
)
def test_typed_topic_names_are_validated(name: str, problem: tuple[str, int] | None) -> None:
    assert names.validate_topic_name(name) == problem


@pytest.mark.parametrize(
    ("name", "namespace", "full"),
    [
        ("a", "/", "/a"),
        ("a", "/ns", "/ns/a"),
        ("a/b", "/x/y", "/x/y/a/b"),
        ("/a", "/ns", "/a"),
        ("~", "/", "/n"),
        ("~/a", "/ns", "/ns/n/a"),
        ("{node}/a", "/ns", "/ns/n/a"),
        ("{ns}/a", "/ns", "/ns/a"),
        ("{namespace}/a", "/ns", "/ns/a"),
        ("/x/{node}", "/ns", "/x/n"),
        ("a{node}b", "/", "/anb"),
    ],
)
def test_names_are_expanded(name: str, namespace: str, full: str) -> None:
    assert names.expand(name, "n", namespace) == full


@pytest.mark.parametrize(("name", "shown"), [("{x}", "{x}"), ("a/{}", "{}"), ("{node}/{nod}", "{nod}")])
def test_unknown_substitutions_are_rejected(name: str, shown: str) -> None:
    with pytest.raises(ValueError, match=r"^unknown substitution: ") as caught:
        names.expand(name, "n", "/")
    assert str(caught.value) == f"unknown substitution: {shown}"


@pytest.mark.parametrize(
    ("namespace", "words"),
    [
        ("/a/", "node name must not start with a number"),
        ("a", "node name must not contain characters other than alphanumerics or '_'"),
        ("/a b", "node name length should not exceed '255'"),
        ("/a//b", "unknown result code for rmw_validate_node_name"),
        ("/" + "a" * 300, "unknown result code for rmw_validate_node_name"),
    ],
)
def test_namespace_error_is_phrased_as_for_node_names(namespace: str, words: str) -> None:
    problem = names.validate_namespace(namespace)
    assert problem is not None
    assert names.namespace_problem_of_new_node(problem[0]) == words


@pytest.mark.parametrize(
    ("enclave", "problem"),
    [
        ("/", None),
        ("/" + "a" * 254, None),
        ("", ("context name must not be empty", 0)),
        ("/a/", ("context name must not end with a '/', unless only a '/'", 2)),
        ("/a//b", ("context name must not contain repeated '/'", 3)),
        ("/" + "a" * 255, ("context name should not exceed 'RCL_ENCLAVE_NAME_MAX_NAME_LENGTH'", 254)),
    ],
)
def test_enclaves_are_validated(enclave: str, problem: tuple[str, int] | None) -> None:
    assert names.validate_enclave(enclave) == problem
