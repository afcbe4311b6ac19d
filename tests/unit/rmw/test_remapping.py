"""Remap rules: their grammar, and which of them matches a name."""

from __future__ import annotations

import pytest
from bot_console.runtime.rmw import remapping
from bot_console.runtime.rmw.lexer import GrammarError

ACCEPTED = (
    "foo:=bar",
    "~/foo:=~/bar",
    "/foo/bar:=bar",
    "node:/foo:=/bar",
    "_:=kq",
    "a/b:=/c/d",
    "n:~/a:=b",
    "__node:=new",
    "__name:=new",
    "old:__node:=new",
    "__ns:=/a",
    "__ns:=/",
    "__ns:=/a/b/",
    "n:__ns:=/a",
    "rostopic://foo:=bar",
    "rosservice:///foo:=bar",
    "n:rostopic://~/a:=b",
)


@pytest.mark.parametrize("text", ACCEPTED)
def test_valid_rules_are_accepted(text: str) -> None:
    remapping.parse_rule(text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "Expecting token or wildcard"),
        (":", "Expecting token or wildcard"),
        ("1", "Expecting token or wildcard"),
        ("~", "Expecting token or wildcard"),
        (":=", "Expecting token or wildcard"),
        (":=bar", "Expecting token or wildcard"),
        ("}foo:=/bar", "Expecting token or wildcard"),
        ("foo:=", "error not set"),
        ("a:=1b", "error not set"),
        ("a:={node}", "error not set"),
        ("f oo:=/bar", "Expected lexeme type (19) not found, search ended at index 1"),
        ("a", "Expected lexeme type (19) not found, search ended at index 1"),
        ("__node:=/foo/bar", "Expected lexeme type 18, got 19 at index 8"),
        ("__node:=", "Expected lexeme type (18) not found, search ended at index 8"),
        ("__ns:=foo", "Expected lexeme type 19, got 18 at index 6"),
        ("__ns:=/a//b", "Expected lexeme type 1, got 19 at index 9"),
        ("*:=b", "Wildcard '*' is not implemented"),
        ("**:=b", "Wildcard '**' is not implemented"),
        (r"a:=\1", "Backreferences are not implemented"),
    ],
)
def test_invalid_rules_are_rejected(text: str, words: str) -> None:
    with pytest.raises(GrammarError) as caught:
        remapping.parse_rule(text)
    assert str(caught.value) == words


def rules(*texts: str) -> list[remapping.RemapRule]:
    return [remapping.parse_rule(text) for text in texts]


@pytest.mark.parametrize(
    ("texts", "namespace", "full", "topic", "service"),
    [
        (("a:=b",), "/", "/a", "/b", "/b"),
        (("a:=b",), "/", "/c", "/c", "/c"),
        (("a:=b",), "/ns", "/ns/a", "/ns/b", "/ns/b"),
        (("a:=b",), "/ns", "/a", "/a", "/a"),
        (("/a:=/b",), "/ns", "/a", "/b", "/b"),
        (("~/a:=b",), "/ns", "/ns/n/a", "/ns/b", "/ns/b"),
        (("a:=~/b",), "/ns", "/ns/a", "/ns/n/b", "/ns/n/b"),
        (("a:=b", "b:=c"), "/", "/a", "/b", "/b"),
        (("a:=b", "a:=c"), "/", "/a", "/b", "/b"),
        (("a:=b",), "/", "/a/x", "/a/x", "/a/x"),
        (("m:a:=b",), "/", "/a", "/a", "/a"),
        (("a:=x", "n:a:=y"), "/", "/a", "/x", "/x"),
        (("rostopic://a:=b",), "/", "/a", "/b", "/a"),
        (("rosservice://a:=b",), "/", "/a", "/a", "/b"),
    ],
)
def test_topics_and_services_are_remapped(
    texts: tuple[str, ...], namespace: str, full: str, topic: str, service: str
) -> None:
    given = rules(*texts)
    assert remapping.remap_topic(given, "n", namespace, full) == topic
    assert remapping.remap_service(given, "n", namespace, full) == service


@pytest.mark.parametrize(
    ("texts", "name", "namespace"),
    [
        ((), None, None),
        (("__node:=x", "__node:=y"), "x", None),
        (("__ns:=/x",), None, "/x"),
        (("m:__node:=x", "n:__ns:=/y"), None, "/y"),
        (("a:=b",), None, None),
    ],
)
def test_node_names_and_namespaces_are_remapped(
    texts: tuple[str, ...], name: str | None, namespace: str | None
) -> None:
    given = rules(*texts)
    assert remapping.remap_node_name(given, "n") == name
    assert remapping.remap_namespace(given, "n") == namespace
