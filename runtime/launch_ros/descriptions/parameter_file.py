"""A parameter file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import yaml
from bot_console.runtime.files.remote_address import is_remote
from bot_console.runtime.process.scratch import scratch_file
from launch.frontend.parse_substitution import parse_substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

PREFIX = "launch_params_"


class ParameterFile:
    """A parameter file, whose text may contain substitutions if `allow_substs` is set."""

    def __init__(self, param_file: SomeSubstitutionsType, *, allow_substs: object = False) -> None:
        self.__param_file = normalize_to_list_of_substitutions(param_file)
        self.__allow_substs = normalize_typed_substitution(allow_substs, data_type=bool)
        self.__evaluated: Path | None = None

    @property
    def param_file(self) -> Any:
        """The path; evaluated when the launch runs."""
        return self.__param_file if self.__evaluated is None else self.__evaluated

    @property
    def allow_substs(self) -> Any:
        """Whether substitutions in the file's text are evaluated."""
        return self.__allow_substs

    def __str__(self) -> str:
        return f"launch_ros.description.ParameterFile(param_file={self.param_file}, allow_substs={self.allow_substs})"

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path, or the path of a copy in which the substitutions are evaluated. The first result is kept.

        For a file on a server, it is the path of the downloaded copy. Raises `OSError` for a file that cannot be
        fetched from its server or, with substitutions, cannot be read; `SubstitutionFailure` for one that is not valid
        YAML after substitution.
        """
        if self.__evaluated is None:
            place = perform_substitutions(context, self.__param_file)
            path = _fetch(context, place) if is_remote(place) else Path(place)
            self.__allow_substs = perform_typed_substitution(context, self.__allow_substs, data_type=bool)
            self.__evaluated = _substitute(context, path) if self.__allow_substs else path
        return self.__evaluated

    def cleanup(self) -> None:
        """Delete the copy, if one was made."""
        if self.__allow_substs is True and self.__evaluated is not None:
            self.__evaluated.unlink(missing_ok=True)
            self.__evaluated = None


_copies: WeakKeyDictionary[LaunchContext, dict[str, Path]] = WeakKeyDictionary()
"""Files downloaded for each launch: all its nodes start with the same text, and waits for a silent server only once."""


def _fetch(context: LaunchContext, address: str) -> Path:
    from bot_console.runtime.files.remote_parameters import local_copy

    copies = _copies.setdefault(context, {})
    if address not in copies:
        copies[address] = local_copy(address)
    return copies[address]


def _substitute(context: LaunchContext, path: Path) -> Path:
    text = perform_substitutions(context, parse_substitution(path.read_text(encoding="utf-8")))
    try:
        yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise SubstitutionFailure("The substituted parameter file is not a valid yaml file") from error
    return scratch_file(PREFIX, text)
