"""Validation and expansion of node, namespace, topic and service names.

Each check returns None for a valid name, otherwise rcl's or rmw's message and the index of the invalid character.
"""

from __future__ import annotations

import re

MAX_NODE_NAME = 255
MAX_TOPIC_NAME = 247
MAX_NAMESPACE = 245
MAX_ENCLAVE = 255
"""Maximum lengths in characters."""

Problem = tuple[str, int]

_OUTSIDE_NODE = re.compile(r"[^A-Za-z0-9_]")
_OUTSIDE_FULL = re.compile(r"[^A-Za-z0-9_/]")
_DIGIT_TOKEN = re.compile(r"/([0-9])")
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*\Z")
_TYPED_CHARACTERS = re.compile(r"[A-Za-z0-9_/~{}]")
_NODE_CHARACTERS = re.compile(r"[A-Za-z0-9_]")


def validate_node_name(name: str) -> Problem | None:
    """Check the name of a node."""
    if not name:
        return "node name must not be empty", 0
    outside = _OUTSIDE_NODE.search(name)
    if outside:
        return "node name must not contain characters other than alphanumerics or '_'", outside.start()
    if name[0].isdigit():
        return "node name must not start with a number", 0
    if len(name) > MAX_NODE_NAME:
        return f"node name length should not exceed '{MAX_NODE_NAME}'", MAX_NODE_NAME - 1
    return None


def validate_namespace(namespace: str) -> Problem | None:
    """Check a namespace, which must be absolute."""
    return _validate_path(namespace, "namespace", MAX_NAMESPACE, "RMW_NAMESPACE_MAX_NAME_LENGTH")


def validate_enclave(enclave: str) -> Problem | None:
    """Check the path of an enclave, which follows the rules of a namespace but may be longer."""
    return _validate_path(enclave, "context name", MAX_ENCLAVE, "RCL_ENCLAVE_NAME_MAX_NAME_LENGTH")


def _validate_path(path: str, what: str, maximum: int, constant: str) -> Problem | None:
    """Check an absolute path, which may be `/` alone; `constant` is upstream's name for the maximum length."""
    if not path:
        return f"{what} must not be empty", 0
    if path == "/":
        return None
    problem = _validate_full(path, what)
    if not problem and len(path) > maximum:
        return f"{what} should not exceed '{constant}'", maximum - 1
    return problem


def validate_full_topic_name(name: str) -> Problem | None:
    """Check a fully expanded topic or service name."""
    if not name:
        return "topic name must not be empty", 0
    problem = _validate_full(name, "topic name")
    if problem:
        return problem
    if len(name) > MAX_TOPIC_NAME:
        return "topic length should not exceed '255U - 8U'", MAX_TOPIC_NAME - 1
    return None


def _validate_full(name: str, what: str) -> Problem | None:
    if name[0] != "/":
        return f"{what} must be absolute, it must lead with a '/'", 0
    if name[-1] == "/":
        unless = "" if what == "topic name" else ", unless only a '/'"
        return f"{what} must not end with a '/'{unless}", _last_byte(name)
    outside = _OUTSIDE_FULL.search(name)
    if outside:
        return f"{what} must not contain characters other than alphanumerics, '_', or '/'", outside.start()
    repeated = name.find("//")
    if repeated >= 0:
        return f"{what} must not contain repeated '/'", repeated + 1
    digit = _DIGIT_TOKEN.search(name)
    if digit:
        return f"{what} must not have a token that starts with a number", digit.start(1)
    return None


def _last_byte(name: str) -> int:
    """Return the index of the name's last byte: rcl counts bytes, not characters."""
    return len(name.encode("utf-8", "surrogateescape")) - 1


def validate_topic_name(name: str) -> Problem | None:
    """Check a topic or service name before expansion: relative, private or absolute, with substitutions."""
    if _PLAIN.match(name):
        return None
    if not name:
        return "topic name must not be empty string", 0
    if name[0].isdigit():
        return "topic name token must not start with a number", 0
    if name[-1] == "/":
        return "topic name must not end with a forward slash", _last_byte(name)
    problem = _validate_characters(name)
    if problem:
        return problem
    if name[0] == "~" and name[1:2] != "/" and len(name) > 2:  # rcl does not check the last character, so `~a` passes
        return "topic name must not have a tilde '~' that is not followed by a forward slash '/'", 1
    digit = _DIGIT_TOKEN.search(name)
    if digit:
        return "topic name token must not start with a number", digit.start(1)
    return None


def _validate_characters(name: str) -> Problem | None:
    opened = -1
    for index, character in enumerate(name):
        if not _TYPED_CHARACTERS.match(character) and opened < 0:
            words = "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'"
            return words, index
        if character == "~" and index:  # also within braces
            return "topic name must not have tilde '~' unless it is the first character", index
        if opened >= 0 and character != "}":
            problem = _validate_substitution(name, opened, index)
            if problem:
                return problem
        elif character == "}":
            if opened < 0:
                return "topic name must not have unmatched (unbalanced) curly braces '{}'", index
            opened = -1
        elif character == "{":
            opened = index
    if opened >= 0:
        return "topic name must not have unmatched (unbalanced) curly braces '{}'", opened
    return None


def _validate_substitution(name: str, opened: int, index: int) -> Problem | None:
    if not _NODE_CHARACTERS.match(name[index]):
        return "substitution name must not contain characters other than alphanumerics or '_'", index
    if index == opened + 1 and name[index].isdigit():
        return "substitution name must not start with a number", index
    return None


def full_name(namespace: str, name: str) -> str:
    """Return a node's fully qualified name."""
    return f"{namespace.rstrip('/')}/{name}"


def expand(name: str, node: str, namespace: str) -> str:
    """Expand a valid topic or service name; raises `ValueError` with rcl's wording for an unknown substitution."""
    if name[0] == "/" and "{" not in name:
        return name
    prefix = namespace.rstrip("/")
    if name[0] == "~":
        name = f"{prefix}/{node}{name[1:]}"
    if "{" in name:
        name = _substitute(name, node, namespace)
    return name if name[0] == "/" else f"{prefix}/{name}"


def _substitute(name: str, node: str, namespace: str) -> str:
    known = {"node": node, "ns": namespace, "namespace": namespace}

    def value(found: re.Match[str]) -> str:
        if found[1] not in known:
            raise ValueError(f"unknown substitution: {found[0]}")
        return known[found[1]]

    return re.sub(r"\{([^}]*)\}", value, name)


_NAMESPACE_PROBLEMS = ("empty", "absolute", "must not end", "characters", "repeated", "token", "exceed")
_NODE_NAME_PROBLEMS = (
    "node name must not be empty",
    "node name must not contain characters other than alphanumerics or '_'",
    "node name must not start with a number",
    f"node name length should not exceed '{MAX_NODE_NAME}'",
)


def rmw_result_code(problem: str) -> int:
    """Return rmw's number for a message of `validate_node_name` or `validate_namespace`."""
    known = _NODE_NAME_PROBLEMS if problem.startswith("node name") else _NAMESPACE_PROBLEMS
    return 1 + next(place for place, words in enumerate(known) if words in problem)


def namespace_problem_of_new_node(namespace_problem: str) -> str:
    """Return rmw's message for an invalid namespace of a new node, which rmw looks up among those for node names."""
    number = next(place for place, word in enumerate(_NAMESPACE_PROBLEMS) if word in namespace_problem)
    known = number < len(_NODE_NAME_PROBLEMS)
    return _NODE_NAME_PROBLEMS[number] if known else "unknown result code for rmw_validate_node_name"
