"""A node's own modules, imported anew for each node process, so that two processes share no module state.

`import` statements look up `__import__` in the builtins of their module (documented with `exec`). A node's modules get
their own builtins, whose `__import__` keeps modules from the node's folders separate and leaves all others to the
interpreter.
"""

from __future__ import annotations

import builtins
import importlib
import importlib.util
import sys
from _thread import RLock
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib.machinery import FileFinder, ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

from ..node.thread_state import local
from .module_table import ModuleTable

_import_module = importlib.import_module
NameTest = Callable[[str], bool]


def _nothing(_name: str) -> bool:
    return False


class FreshModules:
    """The modules that one node process has for itself.

    These are the modules found in `folders` or in what the process adds to `sys.path`, and the top-level names in
    `packages`, wherever they are found. A name for which `shared` is true is never among them. A top-level package
    whose loader has `stands_for`, another package's name, is an alias of that package.
    """

    def __init__(
        self, folders: Sequence[str] = (), *, packages: Iterable[str] = (), shared: NameTest = _nothing
    ) -> None:
        self.folders = list(folders)
        self.builtins: dict[str, Any] = {**vars(builtins), "__import__": self._import}
        self.packages = frozenset(packages)
        self._shared = shared
        self._modules: dict[str, ModuleType] = {}
        self.table = ModuleTable(self._modules)
        self._tops: dict[str, ModuleSpec | None] = {}
        self._searched: list[str] = []
        self._lock = RLock()
        self._base_path = frozenset(sys.path)
        for folder in folders:
            # A file written a moment ago may be missing in the interpreter's cached listing.
            _forget_listing(folder)

    def owns(self, name: str) -> bool:
        """Whether a dotted module name is, or would be, one of these."""
        return self._top_spec(name.partition(".")[0]) is not None

    def load(self, name: str) -> ModuleType:
        """Return the own module of that dotted name, importing it if needed. Raises `ModuleNotFoundError`."""
        with self._lock:
            module = self._modules.get(name)
            return self._execute(name) if module is None else module

    def new_main(self) -> ModuleType:
        """Return an empty `__main__` whose imports are the process's own."""
        main = self._modules["__main__"] = ModuleType("__main__")
        vars(main)["__builtins__"] = self.builtins
        return main

    def _top_spec(self, top: str) -> ModuleSpec | None:
        added = [folder for folder in sys.path if folder not in self._base_path]
        if added != self._searched:
            self._searched = added
            self._tops = {name: spec for name, spec in self._tops.items() if spec is not None}
        if top not in self._tops:
            self._tops[top] = None if self._shared(top) else self._find_top(top)
        return self._tops[top]

    def _find_top(self, top: str) -> ModuleSpec | None:
        spec = PathFinder.find_spec(top, [*self.folders, *self._searched])
        if spec is not None and spec.loader is None:  # a folder without __init__.py: regular modules take precedence
            other = _find_spec(top, None)
            spec = spec if other is None or other.loader is None else None
        return _find_spec(top, None) if spec is None and top in self.packages else spec

    def _execute(self, name: str) -> ModuleType:
        top, _, rest = name.partition(".")
        stands_for = getattr(getattr(self._top_spec(top), "loader", None), "stands_for", None)
        if stands_for is not None:  # an alias of a package: the same modules
            full_name = f"{stands_for}.{rest}" if rest else stands_for
            module = self.load(full_name) if self.owns(full_name) else _import_module(full_name)
            self._modules[name] = module
            return module
        parent_name, _, child = name.rpartition(".")
        parent: ModuleType | None = None
        if not parent_name:
            spec = self._top_spec(name)
        else:
            parent = self.load(parent_name)
            if name in self._modules:
                return self._modules[name]
            if not hasattr(parent, "__path__"):
                raise ModuleNotFoundError(f"No module named {name!r}; {parent_name!r} is not a package", name=name)
            spec = _find_spec(name, parent.__path__)
        if spec is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return self._run(spec, parent, child)

    def _run(self, spec: ModuleSpec, parent: ModuleType | None, child: str) -> ModuleType:
        module = importlib.util.module_from_spec(spec)
        vars(module)["__builtins__"] = self.builtins
        self._modules[spec.name] = module
        if parent is not None:
            setattr(parent, child, module)  # before it runs: on a circular import the interpreter looks here first
        try:
            if spec.loader is not None:
                spec.loader.exec_module(module)
        except BaseException:
            self._modules.pop(spec.name, None)
            if parent is not None and vars(parent).get(child) is module:
                delattr(parent, child)
            raise
        return self._modules[spec.name]

    def _import(
        self,
        name: str,
        globals: Mapping[str, Any] | None = None,
        locals: Mapping[str, Any] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        """The `__import__` of the process's own modules."""
        absolute = name if level == 0 else importlib.util.resolve_name("." * level + name, _package(globals))
        if not self.owns(absolute):
            return builtins.__import__(name, globals, locals, fromlist or (), level)
        module = self.load(absolute)
        if not fromlist:
            return module if level else self.load(absolute.partition(".")[0])
        if hasattr(module, "__path__"):
            self._load_submodules(module, fromlist)
        return module

    def _load_submodules(self, module: ModuleType, names: Iterable[str]) -> None:
        """Do what `from package import name` does: a name that the package lacks may be a submodule."""
        for name in names:
            if name == "*":
                self._load_submodules(module, (n for n in getattr(module, "__all__", ()) if n != "*"))
            elif not hasattr(module, name):
                full_name = f"{module.__name__}.{name}"
                try:
                    self.load(full_name)
                except ModuleNotFoundError as error:
                    if error.name != full_name:
                        raise


def _package(variables: Mapping[str, Any] | None) -> str:
    package = (variables or {}).get("__package__")
    if package is None and variables is not None:
        name = variables.get("__name__", "")
        package = name if "__path__" in variables else name.rpartition(".")[0]
    if not package:
        raise ImportError("attempted relative import with no known parent package")
    return package


def _find_spec(name: str, path: Sequence[str] | None) -> ModuleSpec | None:
    for finder in sys.meta_path:
        spec = finder.find_spec(name, path)
        if spec is not None:
            return spec
    return None


def _forget_listing(folder: str) -> None:
    """Invalidate the interpreter's cached listing of a folder, so that a file added a moment ago is found."""
    finder = sys.path_importer_cache.get(folder)
    if isinstance(finder, FileFinder):
        finder.invalidate_caches()


def import_module(name: str, package: str | None = None) -> ModuleType:
    """`importlib.import_module`: prefers the calling node process's own modules."""
    modules = local.process.modules
    if modules is not None:
        absolute = importlib.util.resolve_name(name, package) if name.startswith(".") else name
        if modules.owns(absolute):
            return modules.load(absolute)
    return _import_module(name, package)
