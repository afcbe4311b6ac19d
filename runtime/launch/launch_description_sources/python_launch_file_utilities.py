"""Python launch files."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import ModuleType
from typing import Any

from launch.launch_place import tell_place

FUNCTION = "generate_launch_description"


class InvalidPythonLaunchFileError(Exception):
    """A Python file that is no launch file."""


def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType:
    """Run a launch file as a module; raises what the file raises."""
    loader = SourceFileLoader("python_launch_file", python_launch_file_path)
    spec = spec_from_loader(loader.name, loader)
    if spec is None:
        raise InvalidPythonLaunchFileError(f"cannot load {python_launch_file_path}")
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(python_launch_file_path: str) -> Any:
    """The description that a launch file generates."""
    try:
        return _generate(python_launch_file_path)
    except Exception as error:
        tell_place(error, python_launch_file_path)
        raise


def _generate(python_launch_file_path: str) -> Any:
    module = load_python_launch_file_as_module(python_launch_file_path)
    if not hasattr(module, FUNCTION):
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' does not contain the required function '{FUNCTION}()'"
        )
    return getattr(module, FUNCTION)()
