"""The text of `ros2 interface show`: a definition, with nested definitions indented below their fields."""

from __future__ import annotations

import re

from bot_console.runtime.rosidl.parse import without_comment
from bot_console.runtime.rosidl.texts import definition_text, known_packages

PRIMITIVES = frozenset(
    [
        "bool",
        "byte",
        "char",
        "float32",
        "float64",
        "int8",
        "uint8",
        "int16",
        "uint16",
        "int32",
        "uint32",
        "int64",
        "uint64",
        "string",
        "wstring",
    ]
)
FIELD = re.compile(r"^(?P<type>[A-Za-z][\w/]*)(?P<bound><=\d+)?(?P<array>\[[^\]]*\])?\s+(?P<name>\w+)\s*(?P<rest>.*)$")
CONSTANT = re.compile(r"^[A-Za-z]\w*(<=\d+)?\s+[A-Z][A-Z0-9_]*\s*=")


def show_text(name: str, *, all_comments: bool = False, no_comments: bool = False) -> str:
    """Return the text for `pkg/kind/Name`; raises `LookupError` with upstream's message if it does not exist."""
    package, kind, short = name.split("/")
    if package not in known_packages():
        raise LookupError(f"Unknown package '{package}'")
    text = definition_text(package, kind, short)
    if text is None:
        from ament_index_python.packages import get_package_share_directory

        raise LookupError(f"Could not find the interface '{get_package_share_directory(package)}/{kind}/{short}.idl'")
    return "".join(_lines(text, package, 0, all_comments, not no_comments))


def _lines(text: str, package: str, depth: int, all_comments: bool, comments: bool) -> list[str]:
    found: list[str] = []
    for line in text.splitlines():
        bare = without_comment(line).rstrip()
        if not comments and not bare.strip():
            continue
        shown = line if comments else bare
        found.append("\t" * depth + shown + "\n" if shown or depth == 0 else "\n")
        match = FIELD.match(bare.strip())
        if match and not CONSTANT.match(bare.strip()) and match["type"] not in PRIMITIVES:
            found += _nested(match["type"], package, depth, all_comments)
    return found


def _nested(kind: str, package: str, depth: int, all_comments: bool) -> list[str]:
    owner, _, short = kind.rpartition("/")
    owner = (owner or package).removesuffix("/msg")
    text = definition_text("std_msgs" if kind == "Header" else owner, "msg", short)
    return _lines(text, owner, depth + 1, all_comments, all_comments) if text is not None else []
