"""The `lint` command: checks a file, a package, a folder, or what runs."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable
from pathlib import Path

from bot_console.tui.cli.lint.finding import Finding
from bot_console.tui.cli.lint.launch_file import dead_parameters
from bot_console.tui.cli.lint.python_file import Declared
from bot_console.tui.cli.lint.python_file import lint as lint_python

PATIENCE = 5.0
"""Seconds in which the parameters of running nodes are read."""


def run(words: list[str]) -> int:
    """Lint; 0 if nothing was found, 1 if something was, 2 for wrong usage."""
    parser = argparse.ArgumentParser(
        "bot-console lint",
        description="What parameters leave unsaid: description, range, unit, validation; and values that reach nobody.",
        epilog="exit codes: 0 nothing found, 1 something found, 2 wrong usage",
    )
    parser.add_argument("what", metavar="PACKAGE | FILE | FOLDER | running", help="running: the nodes of the domain")
    parser.add_argument("--json", action="store_true", help="a list for programs")
    given = parser.parse_args(words)
    problem, found = _running() if given.what == "running" else _of_files(given.what)
    if problem:
        print(problem, file=sys.stderr)
        return 2
    if given.json:
        fields = ("place", "line", "fault", "subject", "mend")
        print(json.dumps([{name: getattr(each, name) for name in fields} for each in found], indent=2))
    else:
        for each in found:
            print(each.text())
        print(f"{len(found)} found" if found else "nothing found", file=sys.stderr)
    return 1 if found else 0


def _of_files(what: str) -> tuple[str, list[Finding]]:
    files = files_of(what)
    if not files:
        return f"there is no file, folder or package '{what}' with Python or YAML files in it", []
    return "", lint_files(files)


def files_of(what: str) -> list[Path]:
    """The Python and YAML files that an argument stands for."""
    path = Path(what)
    if path.is_file():
        return [path]
    if not path.is_dir():
        from bot_console.runtime.importer import install
        from bot_console.runtime.workspace.discover import workspace
        from bot_console.runtime.workspace.own import NAME, own_package

        install()
        package = own_package() if what == NAME else workspace().packages.get(what)
        if package is None:
            return []
        path = package.folder
    return sorted(
        each for each in path.rglob("*") if each.suffix in (".py", ".yaml", ".yml") and "test" not in each.parts
    )


def lint_files(files: Iterable[Path]) -> list[Finding]:
    """The faults of files; parameter and launch files are compared with what the Python files declare."""
    found: list[Finding] = []
    declared = Declared()
    parameters: list[Path] = []
    launches: list[Path] = []
    for path in files:
        if path.suffix != ".py":
            parameters.append(path)
            continue
        try:
            own, names = lint_python(path)
        except (SyntaxError, UnicodeDecodeError, OSError) as error:
            print(f"{path}: cannot be read: {error}", file=sys.stderr)
            declared.whole = False
            continue
        found += own
        launches += [path] if path.stem.endswith("launch") else []
        declared.nodes |= names.nodes
        declared.parameters |= names.parameters
        declared.whole = declared.whole and names.whole
    for path in parameters if declared.nodes else ():
        found += _of_parameter_file(path, declared)
    for path in launches if declared.parameters and declared.whole else ():
        found += dead_parameters(path, frozenset(declared.parameters))
    return sorted(found)


def _of_parameter_file(path: Path, declared: Declared) -> Iterable[Finding]:
    """Keys that match no node, and parameters that nobody declares."""
    from bot_console.tui.console.parameters.file.node_keys import is_wildcard
    from bot_console.tui.console.parameters.file.text import KEYWORD, sections

    try:
        text = path.read_text(encoding="utf-8-sig")
        found = sections(text) if KEYWORD in text else []
    except (ValueError, OSError) as error:
        print(f"{path}: {error}", file=sys.stderr)
        return
    for section in found:
        line = section.mapping.line
        if not is_wildcard(section.key) and section.key.rpartition("/")[2] not in declared.nodes:
            yield Finding(str(path), line, "dead key", section.key)
            continue
        for name, place in section.places.items() if declared.whole else ():
            if name not in declared.parameters and name != "use_sim_time" and not name.startswith("qos_overrides."):
                yield Finding(str(path), place.line, "dead parameter", f"{section.key} {name}")


def _running() -> tuple[str, list[Finding]]:
    from bot_console.runtime.importer import install
    from bot_console.tui.cli.system.domain import take_part

    install()
    if alone := take_part():
        return alone, []
    import time

    from bot_console.tui.console.connection.ros_console import RosConsole
    from bot_console.tui.console.parameters.lint import faults

    console = RosConsole()
    console.start()
    try:
        console.wait_ready(PATIENCE)
        deadline, known, still = time.monotonic() + PATIENCE, 0, 0
        while time.monotonic() < deadline and (still < 5 or not known):
            time.sleep(0.1)
            count = sum(len(tree.parameters) for tree in console.snapshot().parameters.values())
            known, still = count, still + 1 if count == known else 0
        trees = console.snapshot().parameters
    finally:
        console.close()
    if not trees:
        return "no node with parameters was found in this ROS domain", []
    return "", sorted(
        Finding(node, 0, fault, each.name)
        for node, tree in trees.items()
        for each in tree.parameters
        for fault in faults(each)
    )
