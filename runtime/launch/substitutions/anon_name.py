"""Unique names."""

from __future__ import annotations

import os
import random
import re
import socket
from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("anon")
class AnonName(Substitution):
    """A unique name; the same prefix always gives the same name."""

    def __init__(self, name: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[AnonName], dict[str, object]]:
        """Parse `$(anon name)`."""
        if len(data) != 1:
            raise TypeError("anon substitution expects 1 argument")
        return cls, {"name": data[0]}

    @property
    def name(self) -> list[Substitution]:
        """The prefix."""
        return self.__name

    def describe(self) -> str:
        """Return a description such as `AnonName('rviz')`."""
        return f"AnonName({describe_all(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the name."""
        name = perform_substitutions(context, self.__name)
        key = f"anon{name}"
        if key not in context.launch_configurations:
            context.launch_configurations[key] = self.compute_name(name)
        return context.launch_configurations[key]

    def compute_name(self, id_value: str) -> str:
        """Create a new name."""
        full = f"{id_value}_{socket.gethostname()}_{os.getpid()}_{random.randint(0, 2**63)}"
        return re.sub(r"[.\-:]", "_", full)
