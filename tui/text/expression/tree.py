"""The syntax tree of an expression."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

OF_ARRAYS = ("min", "max", "mean", "sum", "std", "len", "yaw")
"""Functions of a whole array, or of a quaternion, of one message: `min(/scan/ranges)` or `/scan/ranges.min()`."""


RATE = "rate"
"""The function of a topic as a whole: its messages per second."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number as it was typed."""

    value: int | float


@dataclass(frozen=True, slots=True)
class Span:
    """A length of time, such as `500 ms`."""

    seconds: float


@dataclass(frozen=True, slots=True)
class Name:
    """A name that stands for a number."""

    text: str


@dataclass(frozen=True, slots=True)
class Path:
    """A field of a topic, its rate, or a parameter: `/odom/twist.twist.linear.x`, `rate(/scan)`, `/robot:max_speed`."""

    text: str


@dataclass(frozen=True, slots=True)
class Negation:
    """The negation of a value."""

    of: Tree


@dataclass(frozen=True, slots=True)
class BinaryOperation:
    """A binary operation: one of `+ - * / // % **` and its operands."""

    operator: str
    left: Tree
    right: Tree


@dataclass(frozen=True, slots=True)
class Call:
    """A function and its arguments."""

    function: str
    arguments: tuple[Tree, ...]


Tree: TypeAlias = "Number | Span | Name | Path | Negation | BinaryOperation | Call"


def rate_path(topic: str) -> str:
    """The path of a topic's rate: `rate(/scan)`."""
    return f"{RATE}({topic})"


def topic_of_rate(path: str) -> str:
    """The topic whose rate a path names; empty for any other path."""
    return path[len(RATE) + 1 : -1] if path.startswith(f"{RATE}(") else ""


def is_parameter(path: str) -> bool:
    """Whether a path names a parameter, `/node:name`; the colon of a slice, `/scan/ranges[80:100]`, does not count."""
    return ":" in path.partition("[")[0]


def children(tree: Tree) -> tuple[Tree, ...]:
    """The parts of a tree."""
    if isinstance(tree, Negation):
        return (tree.of,)
    if isinstance(tree, BinaryOperation):
        return (tree.left, tree.right)
    return tree.arguments if isinstance(tree, Call) else ()


def walk(tree: Tree) -> Iterator[Tree]:
    """The tree and everything in it, from left to right."""
    yield tree
    for each in children(tree):
        yield from walk(each)


def paths_of(tree: Tree) -> tuple[str, ...]:
    """The paths in a tree, each once, in order."""
    return tuple(dict.fromkeys(each.text for each in walk(tree) if isinstance(each, Path)))
