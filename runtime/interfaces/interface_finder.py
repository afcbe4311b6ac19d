"""Makes interfaces importable from their definitions: `from my_interfaces.msg import Num`, without a build."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.names import KINDS

if TYPE_CHECKING:
    from pathlib import Path

NEVER_OURS = sys.stdlib_module_names | {"org"}
"""Names for which no workspace is searched; `org` belongs to Jython, and the standard library's `copy` imports it."""

DECIDES = "bot_console_shims.py"
"""The module in a folder of shims that decides what the shims stand for."""


def interface_folders() -> Mapping[str, Path]:
    """Return the packages that define interfaces, with the folders that contain `msg`, `srv` and `action`.

    The workspace's packages take precedence, then those added by the user, the included and the learned ones.
    """
    from bot_console.runtime.interfaces.further_interfaces import added_by_user, unverified_folders
    from bot_console.runtime.interfaces.learned_interfaces import learned_folders
    from bot_console.runtime.workspace.discover import workspace

    theirs = {name: each.folder for name, each in workspace().packages.items() if each.has_interfaces}
    return {**learned_folders(), **unverified_folders(), **added_by_user(), **theirs}


def spec_on_path(fullname: str, path: Sequence[str] | None = None) -> ModuleSpec | None:
    """Return the spec that the path has for a name, unless it is a shim; see `shim_folder`."""
    spec = PathFinder.find_spec(fullname, path)
    if path is None and spec is not None and is_shim(spec.origin):
        return PathFinder.find_spec(fullname, [each for each in sys.path if not is_shim_folder(each)])
    return spec


def is_shim(file: str | None) -> bool:
    """Whether a module's file is a shim of this or another installation of bot-console."""
    return is_shim_folder(os.path.dirname(file or ""))


def is_shim_folder(folder: str) -> bool:
    """Whether a folder on the path contains shims."""
    return os.path.lexists(os.path.join(folder, DECIDES))


class InterfaceFinder:
    """A finder for `sys.meta_path`: interface packages missing from the path, and `msg` modules of Python packages."""

    def __init__(self) -> None:
        self._modules: dict[str, ModuleType] = {}

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a generated module; None for any other name."""
        top, *inside = fullname.split(".")
        if top in NEVER_OURS or len(inside) > 2 or (inside and inside[0] not in KINDS):
            return None
        spec = spec_on_path(fullname, path)
        if spec is not None and spec.loader is not None:
            return spec
        folder = interface_folders().get(top)
        if folder is None or not _exists(folder, inside):
            return spec
        loader: Any = InterfaceLoader(folder, self._modules)
        return ModuleSpec(fullname, loader, origin=str(folder), is_package=loader.is_package(fullname))


def _exists(folder: Path, inside: Sequence[str]) -> bool:
    if len(inside) == 2:
        return _definition(folder, *inside) is not None
    return not inside or next((folder / inside[0]).glob(f"*.{inside[0]}"), None) is not None


def _definition(folder: Path, kind: str, module: str) -> Path | None:
    from bot_console.runtime.rosidl.emit import PARTS_SUFFIX
    from bot_console.runtime.rosidl.names import module_name

    files = (folder / kind).glob(f"*.{kind}")
    wanted = module.removesuffix(PARTS_SUFFIX) if kind == "srv" else module
    return next((each for each in files if module_name(each.stem) == wanted), None)


class InterfaceLoader:
    """Generates a module when it is imported; all node processes share it, since they exchange its messages."""

    def __init__(self, folder: Path, modules: dict[str, ModuleType]) -> None:
        self._folder = folder
        self._modules = modules
        self._kept: ModuleSpec | None = None

    def is_package(self, fullname: str) -> bool:
        """Whether a name is a package: `my_interfaces` and `my_interfaces.msg` are."""
        return fullname.count(".") < 2

    def get_source(self, fullname: str) -> str:
        """Return the Python source; raises `ImportError` with the file, line and mistake of a definition."""
        from bot_console.runtime.rosidl.emit import modules
        from bot_console.runtime.rosidl.emit_holder import package_module
        from bot_console.runtime.rosidl.parse import DefinitionError, parse

        package, *inside = fullname.split(".")
        if not inside:
            return ""
        try:
            if len(inside) == 1:
                return package_module(self._classes(inside[0]))
            path = _definition(self._folder, *inside)
            if path is None:
                raise ImportError(f"no definition of {fullname}", name=fullname)
            text = path.read_text(encoding="utf-8")
            return modules(parse(text, package, inside[0], path.stem, str(path)))[inside[1]]
        except (DefinitionError, OSError, UnicodeDecodeError) as error:
            raise ImportError(str(error), name=fullname) from None

    def _classes(self, kind: str) -> dict[str, str]:
        """Return the names that a folder's module provides, with the modules that define them."""
        from bot_console.runtime.rosidl.names import module_name
        from bot_console.runtime.rosidl.parse import PARTS

        found: dict[str, str] = {}
        for path in sorted((self._folder / kind).glob(f"*.{kind}")):
            module = module_name(path.stem)
            found[path.stem] = module
            if kind != "msg":
                found.update({path.stem + suffix: module for suffix in PARTS[kind]})
        return found

    def _defining(self, fullname: str) -> str:
        """Return what a module's source depends on: a definition's text, or the list of definitions."""
        _, *inside = fullname.split(".")
        if len(inside) == 2:
            path = _definition(self._folder, *inside)
            try:
                return "" if path is None else path.read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError):
                return ""
        return repr(sorted(self._classes(inside[0]).items())) if inside else ""

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Return the module that another node process has already imported, or a new one."""
        module = self._modules.get(spec.name)
        self._kept = module.__spec__ if module is not None else None
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Run a new module; an existing one stays unchanged."""
        if self._kept is not None:
            module.__spec__ = self._kept
            return
        from bot_console.runtime.interfaces.interface_cache import compiled_module

        name = module.__name__
        code = compiled_module(name, self._defining(name), lambda: self.get_source(name))
        exec(code, vars(module))
        self._modules[module.__name__] = module
