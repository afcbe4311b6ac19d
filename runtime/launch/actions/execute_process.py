"""Running a command."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.actions.execute_local import ExecuteLocal
from launch.descriptions import Executable
from launch.frontend.expose import expose_action
from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("executable")
class ExecuteProcess(ExecuteLocal):
    """Runs a command: a list of arguments, each of which may be composed of substitutions."""

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: dict[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        additional_env: dict[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        executable = Executable(cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env)
        super().__init__(process_description=executable, **kwargs)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[Any, dict[str, object]]:
        """Parse the element in XML or YAML."""
        from launch.frontend.process_attributes import parse_process

        _, kwargs = super().parse(entity, parser)
        return cls, parse_process(entity, parser, kwargs, frozenset(ignore or ()))

    @classmethod
    def _parse_cmdline(cls, cmd: str, parser: Parser) -> list[list[Substitution]]:
        """Split a command line into words, for third-party subclasses that need it."""
        from launch.frontend.process_attributes import parse_command_line

        return parse_command_line(cmd, parser)

    @property
    def name(self) -> Any:
        """The label; without its number until prepared."""
        description = self.process_description
        return description.name if description.final_name is None else description.final_name

    @property
    def cmd(self) -> Any:
        """The command; as substitutions until prepared."""
        description = self.process_description
        return description.cmd if description.final_cmd is None else description.final_cmd

    @property
    def cwd(self) -> list[Substitution] | str | None:
        """The working directory; as substitutions until prepared."""
        description = self.process_description
        return description.cwd if description.final_cwd is None else description.final_cwd

    @property
    def env(self) -> Any:
        """The environment; as substitutions until prepared."""
        description = self.process_description
        return description.env if description.final_env is None else description.final_env

    @property
    def additional_env(self) -> Any:
        """Variables added to the environment."""
        return self.process_description.additional_env
