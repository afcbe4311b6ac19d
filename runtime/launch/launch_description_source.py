"""The source of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType


class LaunchDescriptionSource:
    """A launch description that is given, or read from a file when it is first needed."""

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.__launch_description = launch_description
        self.__expanded_location: str | None = None
        self.__location = normalize_to_list_of_substitutions(location)
        self.__method = method

    @property
    def method(self) -> str:
        """How the description is obtained."""
        return self.__method

    @property
    def location(self) -> str:
        """The location; a description of its substitutions until the launch description was read."""
        if self.__expanded_location is not None:
            return self.__expanded_location
        return " + ".join(each.describe() for each in self.__location)

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the description if it can be read without a context, else None."""
        from launch.launch_context import LaunchContext

        if self.__launch_description is not None:
            return self.__launch_description
        try:
            location = perform_substitutions(LaunchContext(), self.__location)
        except Exception:  # a substitution may need a running launch
            return None
        self.__launch_description = self._get_launch_description(location)
        self.__expanded_location = location
        return self.__launch_description

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description, reading the file the first time."""
        location = perform_substitutions(context, self.__location)
        if self.__launch_description is None or self.__expanded_location != location:
            self.__expanded_location = location
            self.__launch_description = self._get_launch_description(location)
        return self.__launch_description

    def _get_launch_description(self, location: str) -> LaunchDescription:
        """Read the description; this base class only returns a given one, and otherwise raises `RuntimeError`."""
        if self.__launch_description is None:
            raise RuntimeError(
                "LaunchDescriptionSource.get_launch_description(): called without launch description being set"
            )
        return self.__launch_description
