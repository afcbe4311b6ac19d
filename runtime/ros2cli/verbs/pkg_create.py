"""`ros2 pkg create`: a new package for colcon; its Python parts run here without a build."""

from __future__ import annotations

import argparse
import getpass
import os
import re
import subprocess
import sys
from xml.sax.saxutils import escape

from ros2cli.command import Result
from ros2cli.verbs import pkg_templates as texts

NAME = re.compile(r"^(?!.*__)(?!.*_$)[a-z][a-z0-9_]*$")
BUILD_TYPES = ("cmake", "ament_cmake", "ament_python")
LICENSES = (
    "Apache-2.0",
    "BSL-1.0",
    "BSD-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "GPL-3.0-only",
    "LGPL-3.0-only",
    "MIT",
    "MIT-0",
)
"""The SPDX identifiers that ament knows."""
LICENSE_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "licenses")

NOT_COMPILED = (
    "programs in C++ are not compiled here; interfaces in its msg/, srv/ and action/ and Python programs that its "
    "CMakeLists.txt installs work without a build"
)


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError):  # for example in a container that has no entry for this user
        return "user"


def arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the verb."""
    add = parser.add_argument
    add("package_name", help="The package name")
    add("--package-format", "--package_format", type=int, default=3, choices=[2, 3], help="The package.xml format.")
    add("--description", default="TODO: Package description", help="The description given in the package.xml")
    add(
        "--license",
        default="TODO: License declaration",
        help="The license attached to this package; this can be an arbitrary string, but a LICENSE file will only be "
        "generated if it is one of the supported licenses (pass '?' to get a list)",
    )
    add("--destination-directory", default=".", help="Directory where to create the package directory")
    add("--build-type", default="ament_cmake", choices=BUILD_TYPES, help="The build type to process the package with")
    add("--dependencies", nargs="+", metavar="DEPENDENCIES", default=[], help="list of dependencies")
    add("--maintainer-email", help="email address of the maintainer of this package")
    add("--maintainer-name", default=_user(), help="name of the maintainer of this package")
    add("--node-name", help="name of the empty executable")
    add("--library-name", help="name of the empty library")


def create(arguments: argparse.Namespace) -> Result:
    """`ros2 pkg create`."""
    if arguments.license == "?":
        print("Supported licenses:", *LICENSES, sep="\n")
        return None
    name = arguments.package_name
    if not NAME.match(name):
        return (
            f"Aborted since the package name '{name}' is invalid: use lower case letters, digits and single underscores"
        )
    if name == "test" and arguments.build_type == "ament_python":
        return "Aborted since 'ament_python' packages can't be named 'test'. Please choose a different package name."
    folder = os.path.join(arguments.destination_directory, name)
    if os.path.exists(folder):
        return (
            f"\nAborted!\nThe directory already exists: {folder}\nEither remove the directory or choose a different "
            "destination directory or package name"
        )
    given = vars(arguments)
    if given["node_name"] and given["node_name"] == given["library_name"]:
        arguments.node_name += "_node"
        print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
        print(f"[WARNING] renaming node to {arguments.node_name}", file=sys.stderr)
    email = arguments.maintainer_email or _git_email() or f"{arguments.maintainer_name}@todo.todo"
    _report(arguments, email)
    if arguments.build_type == "ament_python":
        _write(folder, arguments, email)
    else:
        _write_cmake(folder, arguments, email)
    _license(folder, arguments.license)
    if arguments.build_type != "ament_python":
        print(f"[INFO] [bot-console]: {NOT_COMPILED}", file=sys.stderr)
    return None


def _git_email() -> str:
    try:
        done = subprocess.run(["git", "config", "user.email"], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.strip()


def _report(arguments: argparse.Namespace, email: str) -> None:
    print("going to create a new package")
    print(f"package name: {arguments.package_name}")
    print(f"destination directory: {os.path.abspath(arguments.destination_directory)}")
    print(f"package format: {arguments.package_format}")
    print("version: 0.0.0")
    print(f"description: {arguments.description}")
    print(f"maintainer: ['{arguments.maintainer_name} <{email}>']")
    print(f"licenses: ['{arguments.license}']")
    print(f"build type: {arguments.build_type}")
    print(f"dependencies: {arguments.dependencies}")
    if arguments.node_name:
        print(f"node_name: {arguments.node_name}")
    if arguments.library_name:
        print(f"library_name: {arguments.library_name}")


def _write(folder: str, arguments: argparse.Namespace, email: str) -> None:
    """Create the folders and files, and print a line for each."""
    name, words = arguments.package_name, _words(arguments, email)
    _folder(folder)
    manifest = texts.PACKAGE_XML.substitute(words, buildtool="", tests=texts.PYTHON_TESTS, build_type="ament_python")
    _file(folder, "package.xml", manifest)
    print("creating source folder")
    source = _folder(folder, name)
    _file(folder, "setup.py", texts.SETUP_PY.substitute(words))
    _file(folder, "setup.cfg", texts.SETUP_CFG.substitute(words))
    _file(_folder(folder, "resource"), name, "")
    _file(source, "__init__.py", "")
    tests = _folder(folder, "test")
    for linter, argv in texts.LINTERS.items():
        _file(tests, f"test_{linter}.py", texts.LINTER_TEST.substitute(linter=linter, argv=argv))
    if arguments.node_name:
        _file(source, f"{arguments.node_name}.py", texts.NODE.substitute(words))
    if arguments.library_name:
        _file(_folder(source, arguments.library_name), "__init__.py", "")


def _write_cmake(folder: str, arguments: argparse.Namespace, email: str) -> None:
    """Create the folders and files of a CMake package."""
    from ros2cli.verbs.pkg_cmake import files

    node, library = arguments.node_name or "", arguments.library_name or ""
    words = _words(arguments, email)
    made = files(words, arguments.build_type, arguments.dependencies, node, library)
    _folder(folder)
    _file(folder, "package.xml", made.pop("package.xml"))
    print("creating source and include folder")
    _folder(folder, "src")
    _folder(folder, "include", arguments.package_name)
    for path, text in made.items():
        _file(folder, path, text)


def _folder(*path: str) -> str:
    folder = os.path.join(*path)
    print("creating folder", folder)
    os.makedirs(folder, exist_ok=True)
    return folder


def _file(folder: str, name: str, text: str) -> None:
    path = os.path.join(folder, name)
    print("creating", path)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _words(arguments: argparse.Namespace, email: str) -> dict[str, str]:
    """Return the values for the templates."""
    name, node = arguments.package_name, arguments.node_name
    depends = "".join(f"  <depend>{each}</depend>\n" for each in arguments.dependencies)
    free = {
        "description": arguments.description,
        "email": email,
        "maintainer": arguments.maintainer_name,
        "license": arguments.license,
    }
    return {
        "name": name,
        "format": str(arguments.package_format),
        "dependencies": depends + ("\n" if depends else ""),
        "scripts": f"\n            '{node} = {name}.{node}:main'" if node else "",
        **{key: escape(text) for key, text in free.items()},
        **{f"python_{key}": repr(text) for key, text in free.items()},
    }


def _license(folder: str, identifier: str) -> None:
    """Write the package's license file, or print why there is none."""
    text = _license_text(identifier)
    if text:
        with open(os.path.join(folder, "LICENSE"), "w", encoding="utf-8") as file:
            file.write(text)
    elif identifier in LICENSES:
        print(f"\n[WARNING]: No LICENSE file has been created: put the text of '{identifier}' there.")
    else:
        print(
            f"\n[WARNING]: Unknown license '{identifier}'.  This has been set in the package.xml, but no LICENSE file "
            "has been created.\nIt is recommended to use one of the ament license identifiers:\n" + "\n".join(LICENSES)
        )


def _license_text(identifier: str) -> str:
    """Return the text of a license; empty if it is not included, as for the GPL."""
    path = os.path.join(LICENSE_FOLDER, f"{identifier}.txt")
    if identifier not in LICENSES or not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read()
