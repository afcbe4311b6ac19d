"""The folders of a package."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch.frontend import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import PathJoinSubstitution
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class FindPackage(Substitution):
    """A folder of a package; `/` appends a path."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[FindPackage], dict[str, object]]:
        """Parse `$(find-pkg-share name)`."""
        if len(data) != 1:
            raise AttributeError("find package substitutions expect 1 argument")
        return cls, {"package": data[0]}

    @property
    def package(self) -> list[Substitution]:
        """The package's name."""
        return self.__package

    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return a path below this one."""
        return PathJoinSubstitution([self, additional_path])

    def describe(self) -> str:
        """Return a description such as `FindPackageShare(pkg='p')`."""
        return f"{type(self).__name__}(pkg={describe_all(self.__package)})"

    def find(self, package_name: str) -> str:
        """Return the folder; raises `PackageNotFoundError`."""
        raise NotImplementedError

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return str(Path(self.find(perform_substitutions(context, self.__package))))


@expose_substitution("find-pkg-prefix")
class FindPackagePrefix(FindPackage):
    """The prefix of a package."""

    def find(self, package_name: str) -> str:
        """Return the prefix."""
        return get_package_prefix(package_name)


@expose_substitution("find-pkg-share")
class FindPackageShare(FindPackage):
    """The share folder of a package."""

    def find(self, package_name: str) -> str:
        """Return the share folder."""
        return get_package_share_directory(package_name)
