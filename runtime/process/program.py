"""A main program: a Python file, module or text, or a function named as in `console_scripts`."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial
from importlib.machinery import PathFinder
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

from .crashes import HINT, explain_with
from .node.thread_state import local

NO_MAIN = (
    "An executable of setup.py is a function of a module, and this module has no function main(). Add def main(): "
    "rclpy.init(), make the node, rclpy.spin(node)"
)
NO_ENTRY = "The 'console_scripts' entry in setup.py refers to {0}, which does not exist{1}. Correct that entry"
"""Message for an entry point that does not exist, with what the module has instead."""


def _no_main(exception: BaseException) -> str | None:
    if isinstance(exception, AttributeError) and isinstance(exception.obj, ModuleType) and exception.name == "main":
        return NO_MAIN
    return None


explain_with(_no_main)


class Places(NamedTuple):
    """Where a program's modules are."""

    folders: Sequence[str] = ()
    """Entries for `sys.path`."""
    packages: frozenset[str] = frozenset()
    """Names of embedded packages that the packages of the same name in `folders` replace."""


ANYWHERE = Places()
"""No folders: modules are found only where the interpreter finds them anyway."""


def file_program(path: str, places: Places = ANYWHERE) -> Callable[[], None]:
    """Return a callable that runs a Python file as `python path` does: as `__main__`, its folder first on `sys.path`.

    The callable raises what the file raises; for a file that cannot be read it exits with code 2 and the interpreter's
    message.
    """
    return partial(_run_file, os.path.abspath(path), places)


def module_program(name: str, places: Places) -> Callable[[], None]:
    """Return a callable that runs a module as `python -m name` does: as `__main__`, the working directory first on
    `sys.path`.
    """
    return partial(_run_module, name, places)


def code_program(text: str, places: Places = ANYWHERE) -> Callable[[], None]:
    """Return a callable that runs a text as `python -c text` does."""
    return partial(_run_code, text, places)


def entry_point_program(entry_point: str, places: Places = ANYWHERE) -> Callable[[], None]:
    """Return a callable that runs `module:function`; its result is the exit code, as in `sys.exit(main())`.

    Raises `ValueError` for anything not of the form `module:function`.
    """
    module, separator, function = entry_point.partition(":")
    if not (module.strip() and separator and function.strip()):
        raise ValueError(f"entry point {entry_point!r} must have the form 'module:function'")
    return partial(_run_entry_point, module.strip(), function.split("[")[0].strip(), places)


def _run_file(path: str, places: Places) -> None:
    source = _read(path)
    main = _new_main(places, os.path.dirname(path))
    vars(main).update(__file__=path, __cached__=None)
    exec(compile(source, path, "exec", dont_inherit=True), vars(main))


def _read(path: str) -> bytes:
    try:
        with open(path, "rb") as source_file:
            return source_file.read()
    except OSError as error:
        print(f"python3: can't open file {path!r}: [Errno {error.errno}] {error.strerror}", file=sys.stderr)
        sys.exit(2)


def _run_module(name: str, places: Places) -> None:
    import runpy

    _new_main(places, os.getcwd())
    run: Any = vars(runpy)["_run_module_as_main"]  # what `python -m` calls
    run(name)


def _run_code(text: str, places: Places) -> None:
    main = _new_main(places, "")
    if sys.version_info >= (3, 13):  # from there on, tracebacks show the lines of the `-c` text
        import linecache

        linecache.cache["<string>"] = len(text), None, text.splitlines(keepends=True), "<string>"
    exec(compile(text, "<string>", "exec", dont_inherit=True), vars(main))


def _run_entry_point(module: str, function: str, places: Places) -> None:
    if local.process.main_state is None:  # a composed node shares its process's modules
        _find_modules_in(places)
    sys.exit(_look_up(module, function)())


def _look_up(module_name: str, function: str) -> Callable[[], Any]:
    """Return the function of an entry point; raises what the import raises, with a hint if it does not exist."""
    try:
        module: Any = importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        if error.name and f"{module_name}.".startswith(f"{error.name}."):  # else a module imported by this one
            setattr(error, HINT, NO_ENTRY.format(f"the module {module_name}", ""))
        raise
    found = module
    for name in function.split("."):
        try:
            found = getattr(found, name)
        except AttributeError as error:
            if name == "main":
                raise  # the exception has its own explanation
            functions = _functions(module)
            has = f"; it has {', '.join(functions)}" if functions else ""
            setattr(error, HINT, NO_ENTRY.format(f"{function}() of {module_name}", has))
            raise
    return found


class _ProgramPackageFinder:
    """A finder for `sys.meta_path`: packages in the program's folders precede embedded ones of the same name."""

    def __init__(self, places: Places) -> None:
        self._places = places

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> Any:
        """Return the spec of such a package; None for any other name, and for a folder without `__init__.py`."""
        if path is not None or fullname not in self._places.packages:
            return None
        spec = PathFinder.find_spec(fullname, self._places.folders)
        return spec if spec is not None and spec.loader is not None else None


def _functions(module: ModuleType) -> list[str]:
    """Return the names of the functions that a module defines itself."""
    found: dict[str, object] = vars(module)
    own = (each for each in found.values() if isinstance(each, FunctionType) and each.__module__ == module.__name__)
    return sorted(each.__name__ for each in own)


def _new_main(places: Places, folder: str) -> ModuleType:
    """Return a new `__main__` module, with a folder first on `sys.path`."""
    _find_modules_in(places)
    sys.path.insert(0, folder)
    main = sys.modules["__main__"] = ModuleType("__main__")
    return main


def _find_modules_in(places: Places) -> None:
    sys.path[:0] = places.folders
    sys.meta_path.insert(0, _ProgramPackageFinder(places))
