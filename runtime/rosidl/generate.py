"""Generates the modules of the standard interfaces into `generated/`; run by the build hook, or by hand."""

from __future__ import annotations

import shutil
import sys
import types
from pathlib import Path

HERE = Path(__file__).resolve().parent
PREFIX = "ament-prefix"
"""The folder of the definition files, laid out as in installed packages; its name cannot be imported."""


def main() -> None:
    """Regenerate all modules."""
    _make_importable()  # Imported here: a build runs this in a clone where nothing is installed yet.
    from bot_console.runtime.rosidl.emit import modules
    from bot_console.runtime.rosidl.emit_holder import package_module
    from bot_console.runtime.rosidl.names import module_name
    from bot_console.runtime.rosidl.standard import interfaces

    target = HERE / "generated"
    fresh = HERE / "generated.new"
    shutil.rmtree(fresh, ignore_errors=True)
    folders: dict[Path, dict[str, str]] = {}
    for each, text in interfaces():
        folder = fresh / each.package / each.kind
        folder.mkdir(parents=True, exist_ok=True)
        file = module_name(each.name)
        for module, source in modules(each).items():
            (folder / f"{module}.py").write_text(source, encoding="utf-8")
        share = fresh / PREFIX / "share" / each.package / each.kind
        share.mkdir(parents=True, exist_ok=True)
        (share / f"{each.name}.{each.kind}").write_text(text, encoding="utf-8")
        names = folders.setdefault(folder, {})
        names[each.name] = file
        if each.kind != "msg":
            names.update({part.name: file for part in each.parts})
    for folder, names in folders.items():
        (folder / "__init__.py").write_text(package_module(names), encoding="utf-8")
        (folder.parent / "__init__.py").write_text("", encoding="utf-8")
        (folder.parent / "py.typed").write_text("", encoding="utf-8")
    shutil.rmtree(target, ignore_errors=True)
    fresh.replace(target)
    print(f"{sum(map(len, folders.values()))} interface classes in {target}", file=sys.stderr)


def _make_importable() -> None:
    """Make `bot_console.runtime.rosidl` importable from the source folder, which may not be installed yet."""
    for name, folder in (("bot_console", None), ("bot_console.runtime", HERE.parent)):
        package = types.ModuleType(name)
        package.__path__ = [str(folder)] if folder else []
        sys.modules[name] = package


if __name__ == "__main__":
    main()
