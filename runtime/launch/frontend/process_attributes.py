"""Attributes that all elements that run a process share."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.substitution import Substitution

TEXTS = ("output", "cwd", "name")
DURATIONS = {"sigkill_timeout": str, "sigterm_timeout": str, "respawn_delay": float}


def parse_process(
    entity: Entity, parser: Parser, kwargs: dict[str, object], ignore: frozenset[str]
) -> dict[str, object]:
    """Add the keyword arguments of `ExecuteProcess`, except the ignored ones, which the caller parses."""
    if "cmd" not in ignore:
        kwargs["cmd"] = parse_command_line(entity.get_attr("cmd"), parser)
    for name in TEXTS:
        _set(kwargs, name, entity, parser, ignore)
    _set(kwargs, "launch-prefix", entity, parser, ignore, keyword="prefix")
    _set(kwargs, "respawn", entity, parser, ignore)
    if "on_exit" not in ignore:
        _parse_on_exit(entity, kwargs)
    for name, form in DURATIONS.items():
        if name not in ignore:
            _parse_duration(entity, name, form, kwargs)
    for name, kind in (("respawn_max_retries", int), ("shell", bool), ("emulate_tty", bool)):
        if name not in ignore:
            value = entity.get_attr(name, data_type=kind, optional=True)
            if value is not None:
                kwargs[name] = value
    if "additional_env" not in ignore:
        _parse_env(entity, parser, kwargs)
    return kwargs


def _parse_duration(entity: Entity, name: str, form: Callable[[float], object], kwargs: dict[str, object]) -> None:
    """Parse a number of seconds; a text with substitutions cannot be compared and raises `TypeError`."""
    value = entity.get_attr(name, data_type=float, optional=True)
    if value is None:
        return
    if value < 0.0:
        raise ValueError(f"Attribute {name} of Entity node expected to be a non-negative value but got `{value}`")
    kwargs[name] = form(value)


def _set(
    kwargs: dict[str, object], name: str, entity: Entity, parser: Parser, ignore: frozenset[str], keyword: str = ""
) -> None:
    keyword = keyword or name
    if name not in ignore and keyword not in ignore:
        value = entity.get_attr(name, optional=True)
        if value is not None:
            kwargs[keyword] = parser.parse_substitution(value)


def _parse_on_exit(entity: Entity, kwargs: dict[str, object]) -> None:
    from launch.actions.shutdown_action import Shutdown

    on_exit = entity.get_attr("on_exit", optional=True)
    if on_exit is None:
        return
    if on_exit != "shutdown":
        raise ValueError(
            f"Attribute on_exit of Entity node expected to be shutdown but got `{on_exit}`"
            "Other on_exit actions not yet supported"
        )
    kwargs["on_exit"] = [Shutdown()]


def _parse_env(entity: Entity, parser: Parser, kwargs: dict[str, object]) -> None:
    elements = entity.get_attr("env", data_type=list, optional=True)
    if elements is None:
        return
    kwargs["additional_env"] = {
        tuple(parser.parse_substitution(each.get_attr("name"))): parser.parse_substitution(each.get_attr("value"))
        for each in elements
    }
    for each in elements:
        each.assert_entity_completely_parsed()


def parse_command_line(text: str, parser: Parser) -> list[list[Substitution]]:
    """Split a command line into words as a shell does; the values of substitutions are not split.

    A piece that is only whitespace ends a word, even an empty one; an empty text is one empty word.
    """
    from launch.substitutions.text_substitution import TextSubstitution

    words: list[list[Substitution]] = []
    word: list[Substitution] = []
    for piece in parser.parse_substitution(text):
        if not isinstance(piece, TextSubstitution):
            word.append(piece)
            continue
        parts = shlex.split(piece.text)
        if not parts or (piece.text[0].isspace() and word):
            words.append(word)
            word = []
        for number, part in enumerate(parts):
            if number > 0:
                words.append(word)
                word = []
            word.append(TextSubstitution(text=part))
        if parts and piece.text[-1].isspace():
            words.append(word)
            word = []
    return [*words, word] if word else words
