"""Settings of editors: strings are added to a list, and everything else stays as it was, including comments."""

from __future__ import annotations

import pytest
from bot_console.tui.files.jsonc import JsoncError, load, with_member, with_strings

OURS = "/cache/"

CASES = {
    "empty": ("{\n}\n", '{\n    "paths": [\n        "/cache/1",\n        "/cache/2"\n    ]\n}\n'),
    "comments": (
        '// top\n{\n    "a": 1, // one\n    "paths": [\n        "lib", // mine\n    ], /* end */\n}\n',
        '// top\n{\n    "a": 1, // one\n    "paths": [\n        "lib", // mine\n        "/cache/1",\n'
        '        "/cache/2",\n    ], /* end */\n}\n',
    ),
    "no comma": (
        '{"paths": ["lib" // mine\n]}',
        '{"paths": ["lib", // mine\n        "/cache/1",\n        "/cache/2"\n]}',
    ),
    "one line": ('{"paths": ["lib"], "b": 2}', '{"paths": ["lib",\n        "/cache/1",\n        "/cache/2"], "b": 2}'),
    "block comment": (
        '{"paths": ["lib", /* a\n"b" */ ]}',
        '{"paths": ["lib",\n        "/cache/1",\n        "/cache/2", /* a\n"b" */ ]}',
    ),
    "older ones": (
        '{"paths": [\n"/cache/0", // old\n"lib", "/cache/1", "/cache/9"]}',
        '{"paths": [\n// old\n"lib", "/cache/1",\n        "/cache/2"]}',
    ),
    "nested": (
        '{"x": {"paths": ["/cache/0"]}, "paths": []}',
        '{"x": {"paths": ["/cache/0"]}, "paths": [\n        "/cache/1",\n        "/cache/2"\n    ]}',
    ),
    "text that looks like JSON": (
        '{"x": "\\"paths\\": [ // no", "paths": ["/cache/1", "/cache/2"]}',
        '{"x": "\\"paths\\": [ // no", "paths": ["/cache/1", "/cache/2"]}',
    ),
    "mixed": (
        '{"paths": [{"a": ["/cache/0"]}, 3, "/cache/1"]}',
        '{"paths": [{"a": ["/cache/0"]}, 3, "/cache/1",\n        "/cache/2"]}',
    ),
}


@pytest.mark.parametrize(("text", "expected"), CASES.values(), ids=CASES.keys())
def test_strings_are_added_and_the_rest_is_kept(text: str, expected: str) -> None:
    changed = with_strings(text, "paths", ["/cache/1", "/cache/2"], lambda each: each.startswith(OURS))
    assert changed == expected
    assert load(changed)["paths"][-2:] == ["/cache/1", "/cache/2"]
    assert with_strings(changed, "paths", ["/cache/1", "/cache/2"], lambda each: each.startswith(OURS)) == changed


def test_member_is_added_once() -> None:
    text = with_member('{\n    // c\n    "a": 1\n}', "mode", "basic")
    assert load(text) == {"mode": "basic", "a": 1} and "// c" in text
    assert with_member(text, "mode", "strict") == text


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('{\n"a": }', "line 2: it is not JSON"),
        ('{\n\n"a": [1 2]}', "line 3: it is not JSON"),
        ("{\n'a': 1}", "line 2: it is not JSON"),
        ("[1]", "it is no JSON object"),
        ('{"paths": "lib"}', '"paths" is not a list'),
        ("// nothing", "it is empty"),
        ('{"a": "open}', "line 1: it is not JSON"),
        ("[" * 100_000, "it is not JSON"),
    ],
)
def test_unusable_text_is_refused(text: str, why: str) -> None:
    with pytest.raises(JsoncError, match="^.*" + why.replace("[", r"\[")):
        with_strings(text, "paths", ["x"], lambda each: False)
