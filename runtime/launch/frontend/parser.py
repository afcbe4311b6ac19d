"""Parsers of launch files in XML and YAML."""

from __future__ import annotations

import importlib
import io
import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TextIO

from launch.frontend.entity import Entity
from launch.frontend.expose import action_parse_methods
from launch.frontend.parse_substitution import (
    parse_if_substitutions,
    parse_substitution,
    replace_escaped_characters,
)
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_place import report_place

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_description import LaunchDescription
    from launch.substitution import Substitution

PARSERS = ("launch_xml", "launch_yaml")
EXTENSIONS = ("launch_ros",)
EXTENSION_GROUP = "launch.frontend.launch_extension"


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file is neither valid XML nor valid YAML."""


class Parser:
    """Creates actions from the elements of a launch file."""

    path = ""
    """The path of the file."""

    @classmethod
    def load_launch_extensions(cls) -> None:
        """Import the packages whose actions and substitutions launch files may use."""
        _load_extensions()

    @classmethod
    def load_parser_implementations(cls) -> dict[str, type[Parser]]:
        """Return the parsers by name."""
        return {name.removeprefix("launch_"): importlib.import_module(name).Parser for name in PARSERS}

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the file extensions that the parser reads."""
        return set()

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the file extensions that any parser reads."""
        return [each for parser in cls.load_parser_implementations().values() for each in parser.get_file_extensions()]

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Whether any parser reads files with this extension."""
        return extension in cls.get_available_extensions()

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """Return the root element and its parser; raises `InvalidFrontendLaunchFileError` if none can read the file."""
        cls.load_launch_extensions()
        path = file if isinstance(file, str) else getattr(file, "name", "")
        extension = os.path.splitext(path)[1].removeprefix(".")
        known = extension if cls.is_extension_valid(extension) else ""
        errors: list[BaseException] = []
        try:
            text = _read(path) if isinstance(file, str) else file.read()
        except UnicodeDecodeError as error:
            line = error.object.count(b"\n", 0, error.start) + 1
            error.reason += f"; line {line} is not in UTF-8, which launch files are: save it in that encoding"
            report_place(error, path, line)
            raise InvalidFrontendLaunchFileError(known, likely_errors=[error]) from error
        for parser in cls._parsers_for(path):
            try:
                root, found = parser.load(io.StringIO(text))
                found.path = path
                return root, found
            except Exception as error:  # each library has its own errors; all are reported
                report_place(error, path, _line_of_parse_error(error))
                errors.append(error)
        raise InvalidFrontendLaunchFileError(known, likely_errors=errors)

    @classmethod
    def _parsers_for(cls, path: str) -> list[type[Parser]]:
        """Return all parsers, beginning with those for the file's extension."""
        name = os.path.basename(path)

        def knows(parser: type[Parser]) -> bool:
            return any(name.endswith(f".{each}") for each in parser.get_file_extensions())

        return sorted(cls.load_parser_implementations().values(), key=lambda parser: not knows(parser))

    def parse_action(self, entity: Entity) -> Any:
        """Create the action of an element; raises an error for anything wrong with it."""
        try:
            return self._parse_action(entity)
        except Exception as error:
            report_place(error, self.path, entity.line or None)
            raise

    def _parse_action(self, entity: Entity) -> Any:
        method = action_parse_methods.get(entity.type_name)
        if method is None:
            raise RuntimeError(f"Unrecognized entity of the type: {entity.type_name}")
        kind, options = method(entity, self)
        entity.assert_entity_completely_parsed()
        action = kind(**options)
        action.origin = f"{self.path}:{entity.line}" if entity.line else self.path
        return action

    def parse_substitution(self, value: str) -> list[Substitution]:
        """Parse a text into substitutions."""
        return parse_substitution(value)

    def parse_if_substitutions(self, value: object) -> Any:
        """Parse a text, or texts in a list, into substitutions; other values are returned as they are."""
        return parse_if_substitutions(value)

    def parse_condition(self, entity: Entity) -> Condition | None:
        """Parse the condition of an element; None if it has none."""
        from launch.conditions import IfCondition, UnlessCondition

        if_text = entity.get_attr("if", optional=True)
        unless_text = entity.get_attr("unless", optional=True)
        if if_text is not None and unless_text is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        if if_text is not None:
            return IfCondition(self.parse_substitution(if_text))
        return None if unless_text is None else UnlessCondition(self.parse_substitution(unless_text))

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """Create the launch description of a root element."""
        from launch.launch_description import LaunchDescription

        if entity.type_name != "launch":
            raise RuntimeError("Expected 'launch' as root tag")
        deprecated = entity.get_attr("deprecated", optional=True)
        entity.get_attr("version", optional=True)  # public files use it; ignored, as upstream
        actions = [self.parse_action(each) for each in entity.children]
        entity.assert_entity_completely_parsed()
        return LaunchDescription(actions, deprecated_reason=deprecated)

    def escape_characters(self, value: str) -> str:
        """Remove escaping backslashes from a text."""
        return replace_escaped_characters(value)


def _line_of_parse_error(error: object) -> int | None:
    """Return the line at which the XML or YAML library stopped."""
    mark = getattr(error, "problem_mark", None)
    if mark is not None:
        return mark.line + 1
    position = getattr(error, "position", None)
    return None if position is None else position[0]


def _read(path: str) -> str:
    with open(path, "rb") as file:
        content = file.read()  # decoded as a whole, as an error in a part would not tell the line
    return io.StringIO(content.decode("utf-8"), newline=None).read()


@lru_cache(maxsize=1)
def _load_extensions() -> None:
    from bot_console.runtime.programs.installed_entry_points import installed_entry_points

    for name in EXTENSIONS:
        importlib.import_module(name)
    for module in ("launch.actions", "launch.substitutions"):
        importlib.import_module(module)
    for entry_point in installed_entry_points(EXTENSION_GROUP):
        if entry_point.module not in EXTENSIONS:
            entry_point.load()
