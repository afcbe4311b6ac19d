"""A program with its arguments, environment and working directory."""

from __future__ import annotations

import itertools
import os
import re
import shlex
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

import launch.logging
from bot_console.runtime.process import ProcessLocal
from launch.substitution import Substitution
from launch.substitutions.launch_configuration import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

_numbers: ProcessLocal[Iterator[int]] = ProcessLocal(lambda: itertools.count(1))


def warn_of_text(parameter: str, words: object) -> None:
    """Warn of a text in the place of a list of words: as upstream, each of its letters is one word."""
    if isinstance(words, str) and len(words) > 1:
        launch.logging.get_logger("launch").warning(
            f"{parameter}={words!r} is read letter by letter: give a list of words, {parameter}={words.split()!r}"
        )


class Executable:
    """A program to run; its final command and label are known once prepared."""

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        warn_of_text("cmd", cmd)
        warn_of_text("arguments", arguments)
        self.__cmd = [normalize_to_list_of_substitutions(each) for each in cmd]
        self.__cmd += [normalize_to_list_of_substitutions(each) for each in arguments or ()]
        self.__own_prefix = prefix is not None
        self.__prefix = normalize_to_list_of_substitutions(
            LaunchConfiguration("launch-prefix", default="") if prefix is None else prefix
        )
        self.__prefix_filter = normalize_to_list_of_substitutions(
            LaunchConfiguration("launch-prefix-filter", default="")
        )
        self.__name = name if name is None else normalize_to_list_of_substitutions(name)
        self.__cwd = cwd if cwd is None else normalize_to_list_of_substitutions(cwd)
        self.__env = _pairs(env)
        self.__additional_env = _pairs(additional_env)
        self.__final_cmd: list[str] | None = None
        self.__final_cwd: str | None = None
        self.__final_env: dict[str, str] | None = None
        self.__final_name: str | None = None
        self.__words_of_prefix: list[str] = []

    @property
    def name(self) -> list[Substitution] | None:
        """The label without its number."""
        return self.__name

    @property
    def prefix(self) -> list[Substitution]:
        """The prefix of the command."""
        return self.__prefix

    @property
    def cmd(self) -> list[list[Substitution]]:
        """The command, each word as a list of substitutions."""
        return self.__cmd

    @property
    def cwd(self) -> list[Substitution] | None:
        """The working directory."""
        return self.__cwd

    @property
    def env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """The whole environment."""
        return self.__env

    @property
    def additional_env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """Variables added to the environment."""
        return self.__additional_env

    @property
    def final_name(self) -> str | None:
        """The label with its number, such as `talker-1`."""
        return self.__final_name

    @property
    def final_cmd(self) -> list[str] | None:
        """The command line."""
        return self.__final_cmd

    @property
    def final_cwd(self) -> str | None:
        """The working directory; None for the launch's own."""
        return self.__final_cwd

    @property
    def final_env(self) -> dict[str, str] | None:
        """The whole environment; None until prepared."""
        return self.__final_env

    @property
    def words_of_prefix(self) -> list[str]:
        """The words of the prefix at the start of the final command."""
        return self.__words_of_prefix

    def prepare(self, context: LaunchContext, action: object) -> None:
        """Evaluate all substitutions, and take the next number for the label."""
        cmd = [perform_substitutions(context, each) for each in self.__cmd]
        self.__words_of_prefix = self._prefix_for(context, cmd)
        self.__final_cmd = [*self.__words_of_prefix, *cmd]
        first = os.path.basename(self.__final_cmd[0])
        name = first if self.__name is None else perform_substitutions(context, self.__name)
        self.__final_name = f"{name}-{next(_numbers.get())}"
        self.__final_cwd = None if self.__cwd is None else perform_substitutions(context, self.__cwd)
        self.__final_env = self._environment(context)

    def _prefix_for(self, context: LaunchContext, cmd: list[str]) -> list[str]:
        words = shlex.split(perform_substitutions(context, self.__prefix))
        pattern = perform_substitutions(context, self.__prefix_filter)
        if words and not self.__own_prefix and pattern and not re.match(pattern, os.path.basename(cmd[0])):
            return []
        return words

    def _environment(self, context: LaunchContext) -> dict[str, str]:
        found = dict(context.environment) if self.__env is None else {}
        for name, value in [*(self.__env or ()), *(self.__additional_env or ())]:
            found[perform_substitutions(context, name)] = perform_substitutions(context, value)
        return found


def _pairs(
    values: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None,
) -> list[tuple[list[Substitution], list[Substitution]]] | None:
    if values is None:
        return None
    normalize = normalize_to_list_of_substitutions
    return [(normalize(name), normalize(value)) for name, value in values.items()]
