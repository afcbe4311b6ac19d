"""The output of a command."""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Sequence
from typing import TYPE_CHECKING

import launch.logging
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

WORDS = ("fail", "ignore", "warn", "capture")


@expose_substitution("command")
class Command(Substitution):
    """The standard output of a command, run without a shell."""

    def __init__(self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail") -> None:
        super().__init__()
        self.__command = normalize_to_list_of_substitutions(command)
        self.__on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Command], dict[str, object]]:
        """Parse `$(command 'words' on_stderr)`."""
        if not 1 <= len(data) <= 2:
            raise ValueError("command substitution expects 1 or 2 arguments")
        return cls, {"command": data[0], **({"on_stderr": data[1]} if len(data) > 1 else {})}

    @property
    def command(self) -> list[Substitution]:
        """The command."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """How output on its standard error is handled."""
        return self.__on_stderr

    def describe(self) -> str:
        """Return a description such as `Command('date')`."""
        return f"Command({describe_all(self.__command)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the output with its last newline; raises `SubstitutionFailure` if the command fails."""
        text = perform_substitutions(context, self.__command)
        command = text if os.name == "nt" else shlex.split(text)
        on_stderr = perform_substitutions(context, self.__on_stderr)
        if on_stderr not in WORDS:
            raise SubstitutionFailure("expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'")
        errors = subprocess.STDOUT if on_stderr == "capture" else subprocess.PIPE
        environment = dict(context.environment)
        try:
            done = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=errors, text=True, check=False, env=environment
            )
        except FileNotFoundError as error:
            raise SubstitutionFailure(f"file not found: {error}") from error
        message = f"Command: {text}"
        if done.returncode != 0:
            captured = f"\nCaptured stderr output: {done.stderr}" if done.stderr else ""
            raise SubstitutionFailure(f"executed command failed. {message}{captured}")
        if done.stderr and on_stderr != "ignore":
            problem = f"executed command showed stderr output. {message}\nCaptured stderr output:\n{done.stderr}"
            if on_stderr == "fail":
                raise SubstitutionFailure(problem)
            launch.logging.get_logger().warning(problem)
        return done.stdout
