"""Messages for a missing package or executable: which exist, and what to add."""

from __future__ import annotations

from bot_console.runtime.programs.hints import did_you_mean
from bot_console.runtime.workspace.available_names import all_executable_names, package_names
from bot_console.runtime.workspace.discover import workspace


def no_package(package: str) -> str:
    """Return the message for an unknown package."""
    folders = ", ".join(map(str, workspace().folders)) or "no folder"
    names = package_names()
    meant = did_you_mean(package, names, "'")
    return (
        f"Package '{package}' not found, and there is no such file{meant or '.'} There are: {', '.join(names)}. "
        f"Packages are folders with a package.xml; looked for in {folders}"
    )


def no_executable(package: str, name: str) -> str:
    """Return the message for a package without that executable."""
    has = ", ".join(all_executable_names(package)) or "none"
    return f"No executable found: '{name}' is not in package '{package}', which has: {has}{what_to_add(package, name)}"


def what_to_add(package: str, name: str) -> str:
    """Return what to repair so that a workspace package has it, as a further sentence; empty for other packages."""
    source = workspace().packages.get(package)
    if source is None or not (source.folder / "setup.py").is_file():
        return ""
    if source.problem:
        return f". It has a mistake: {source.problem}"
    module = name.removesuffix(".py")
    there = any((path / f"{module}.py").is_file() for path in source.modules.values())
    first = f"{module}.py is there; add" if there else f"Write {package}/{module}.py with a main(), and add"
    line = f"'{module} = {package}.{module}:main'"
    return f". {first} {line} to 'console_scripts' in {source.folder / 'setup.py'}"
