"""The path of a package's executable."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from bot_console.runtime.workspace.executables import executables
from launch.frontend import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import SubstitutionFailure
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.node_program import container_path

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("exec-in-package")
@expose_substitution("exec-in-pkg")
class ExecutableInPackage(Substitution):
    """The path of a package's executable; if it was never built, the path where its build would install it."""

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__executable = normalize_to_list_of_substitutions(executable)
        self.__package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[ExecutableInPackage], dict[str, object]]:
        """Parse `$(exec-in-pkg executable package)`."""
        if len(data) != 2:
            raise AttributeError("exec-in-package substitution expects 2 arguments")
        return cls, {"executable": data[0], "package": data[1]}

    @property
    def executable(self) -> list[Substitution]:
        """The executable's name."""
        return self.__executable

    @property
    def package(self) -> list[Substitution]:
        """The package's name."""
        return self.__package

    def describe(self) -> str:
        """Return a description such as `ExecInPkg(pkg='p', exec='e')`."""
        return f"ExecInPkg(pkg={describe_all(self.__package)}, exec={describe_all(self.__executable)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path; raises `PackageNotFoundError`, or `SubstitutionFailure` if the package has no such file."""
        executable = perform_substitutions(context, self.__executable)
        package = perform_substitutions(context, self.__package)
        try:
            prefix = get_package_prefix(package)
        except PackageNotFoundError:
            container = container_path(package, executable)
            if container is not None:
                return container
            raise
        libexec = os.path.join(prefix, "lib", package)
        found = shutil.which(executable, path=libexec) if os.path.isdir(libexec) else None
        if found is not None:
            return found
        known = executables(package)
        if executable in known:
            path = known[executable].path
            return os.path.join(libexec, executable) if path is None else str(path)
        if not os.path.isdir(libexec) and not known:
            raise SubstitutionFailure(
                f"package '{package}' found at '{prefix}', but libexec directory '{libexec}' does not exist"
            )
        raise SubstitutionFailure(f"executable '{executable}' not found on the libexec directory '{libexec}' ")
