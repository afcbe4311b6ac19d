"""The main program of a node process: a Python file, or a function named as in `console_scripts`."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Sequence
from importlib.machinery import PathFinder
from types import FunctionType, ModuleType
from typing import Any

from .crashes import HINT, explain_with
from .node.thread_state import local
from .virtual.fresh_import import FreshModules

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


def file_program(path: str, modules: FreshModules | None = None) -> Callable[[], None]:
    """Return a callable that runs a Python file as `python path` does: as `__main__`, its folder first on `sys.path`.

    Modules beside the file are the process's own. The callable raises what the file raises; for a file that cannot be
    read it exits with code 2 and the interpreter's message.
    """
    return _FileProgram(os.path.abspath(path), modules)


def module_program(name: str, modules: FreshModules) -> Callable[[], None]:
    """Return a callable that runs a module as `python -m name` does: as `__main__`, the working directory first on
    `sys.path`.
    """
    return _ModuleProgram(name, modules)


def code_program(text: str, modules: FreshModules) -> Callable[[], None]:
    """Return a callable that runs a text as `python -c text` does."""
    return _CodeProgram(text, modules)


def entry_point_program(entry_point: str, modules: FreshModules | None = None) -> Callable[[], None]:
    """Return a callable that runs `module:function`; its result is the exit code, as in `sys.exit(main())`.

    Raises `ValueError` for anything not of the form `module:function`.
    """
    module, separator, function = entry_point.partition(":")
    if not (module.strip() and separator and function.strip()):
        raise ValueError(f"entry point {entry_point!r} must have the form 'module:function'")
    return _EntryPoint(module.strip(), function.split("[")[0].strip(), modules)


class _FileProgram:
    def __init__(self, path: str, modules: FreshModules | None) -> None:
        self._path = path
        self._modules = modules

    def __call__(self) -> None:
        source = self._read()
        folder = os.path.dirname(self._path)
        main = _new_main(self._modules or FreshModules([folder]), folder)
        vars(main).update(__file__=self._path, __cached__=None)
        exec(compile(source, self._path, "exec", dont_inherit=True), vars(main))

    def _read(self) -> bytes:
        try:
            with open(self._path, "rb") as source_file:
                return source_file.read()
        except OSError as error:
            print(f"python3: can't open file {self._path!r}: [Errno {error.errno}] {error.strerror}", file=sys.stderr)
            sys.exit(2)


class _ModuleProgram:
    def __init__(self, name: str, modules: FreshModules) -> None:
        self._name = name
        self._modules = modules

    def __call__(self) -> None:
        import runpy

        _new_main(self._modules, os.getcwd())
        run: Any = vars(runpy)["_run_module_as_main"]  # what `python -m` calls
        run(self._name)


class _CodeProgram:
    def __init__(self, text: str, modules: FreshModules) -> None:
        self._text = text
        self._modules = modules

    def __call__(self) -> None:
        main = _new_main(self._modules, "")
        exec(compile(self._text, "<string>", "exec", dont_inherit=True), vars(main))


class _EntryPoint:
    def __init__(self, module: str, function: str, modules: FreshModules | None) -> None:
        self._module = module
        self._function = function
        self._modules = modules

    def __call__(self) -> None:
        modules = _adopt(self._modules or FreshModules(packages=[self._module.partition(".")[0]]))
        sys.exit(self._look_up(modules)())

    def _look_up(self, modules: FreshModules | None) -> Callable[[], Any]:
        try:
            own = modules if modules is not None and modules.owns(self._module) else None
            module: Any = importlib.import_module(self._module) if own is None else own.load(self._module)
        except ModuleNotFoundError as error:
            if error.name and f"{self._module}.".startswith(f"{error.name}."):  # else a module that this one imports
                setattr(error, HINT, NO_ENTRY.format(f"the module {self._module}", ""))
            raise
        found = module
        for name in self._function.split("."):
            try:
                found = getattr(found, name)
            except AttributeError as error:
                if name == "main":
                    raise  # which has its own explanation
                functions = _functions(module)
                has = f"; it has {', '.join(functions)}" if functions else ""
                setattr(error, HINT, NO_ENTRY.format(f"{self._function}() of {self._module}", has))
                raise
        return found


class _FoundFirst:
    """A finder of `sys.meta_path`: a package in the program's folders precedes an embedded one of that name."""

    def __init__(self, modules: FreshModules) -> None:
        self._modules = modules

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> Any:
        """Return the spec of such a package; None for every other name, and for a folder without `__init__.py`."""
        if path is not None or fullname not in self._modules.packages:
            return None
        spec = PathFinder.find_spec(fullname, self._modules.folders)
        return spec if spec is not None and spec.loader is not None else None


def _functions(module: ModuleType) -> list[str]:
    """Return the names of the functions that a module itself defines."""
    found: dict[str, object] = vars(module)
    own = (each for each in found.values() if isinstance(each, FunctionType) and each.__module__ == module.__name__)
    return sorted(each.__name__ for each in own)


def _new_main(modules: FreshModules, folder: str) -> ModuleType:
    """Return a new `__main__` module, with a folder first on `sys.path`."""
    adopted = _adopt(modules)
    sys.path.insert(0, folder)
    main = ModuleType("__main__") if adopted is None else adopted.new_main()
    sys.modules["__main__"] = main
    return main


def _adopt(modules: FreshModules) -> FreshModules | None:
    """Make the modules the calling node process's own; the real process gets only their folders on `sys.path`."""
    if local.process.main_state is None:
        sys.path[:0] = modules.folders
        sys.meta_path.insert(0, _FoundFirst(modules))
        return None
    local.process.modules = modules
    return modules
