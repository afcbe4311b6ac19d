"""`ros2 pkg create`: a new Python package that colcon builds and this console runs as it is."""

from __future__ import annotations

import argparse
import getpass
import re
import subprocess
from pathlib import Path
from string import Template

from ros2cli.command import Result

NAME = re.compile(r"^(?!.*__)(?!.*_$)[a-z][a-z0-9_]*$")
BUILD_TYPES = ("ament_cmake", "ament_python", "cmake")

PACKAGE_XML = Template("""\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>$name</name>
  <version>0.0.0</version>
  <description>$description</description>
  <maintainer email="$email">$maintainer</maintainer>
  <license>$license</license>

$dependencies  <test_depend>ament_copyright</test_depend>
  <test_depend>ament_flake8</test_depend>
  <test_depend>ament_pep257</test_depend>
  <test_depend>python3-pytest</test_depend>

  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
""")
SETUP_PY = Template("""\
from setuptools import find_packages, setup

package_name = '$name'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='$maintainer',
    maintainer_email='$email',
    description='$description',
    license='$license',
    tests_require=['pytest'],
    entry_points={
        'console_scripts': [$scripts
        ],
    },
)
""")
SETUP_CFG = Template("""\
[develop]
script_dir=$$base/lib/$name
[install]
install_scripts=$$base/lib/$name
""")
NODE = Template("""\
def main():
    print('Hi from $name.')


if __name__ == '__main__':
    main()
""")


def arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the verb."""
    add = parser.add_argument
    add("package_name", help="The package name")
    add("--package-format", "--package_format", type=int, default=3, choices=[2, 3], help="The package.xml format.")
    add("--description", default="TODO: Package description", help="The description given in the package.xml")
    add("--license", default="TODO: License declaration", help="The license attached to this package")
    add("--destination-directory", default=".", help="Directory where to create the package directory")
    add("--build-type", default="ament_cmake", choices=BUILD_TYPES, help="The build type to process the package with")
    add("--dependencies", nargs="+", metavar="DEPENDENCIES", default=[], help="list of dependencies")
    add("--maintainer-email", help="email address of the maintainer of this package")
    add("--maintainer-name", default=getpass.getuser(), help="name of the maintainer of this package")
    add("--node-name", help="name of the empty executable")
    add("--library-name", help="name of the empty library")


def create(arguments: argparse.Namespace) -> Result:
    """`ros2 pkg create`."""
    name = arguments.package_name
    if not NAME.match(name):
        return (
            f"Aborted since the package name '{name}' is invalid: use lower case letters, digits and single underscores"
        )
    if arguments.build_type != "ament_python":
        return (
            f"A package of build type '{arguments.build_type}' has to be compiled, which this machine's ROS cannot do; "
            "add --build-type ament_python for a Python package"
        )
    folder = Path(arguments.destination_directory) / name
    if folder.exists():
        return f"\nAborted!\nThe directory already exists: {folder.resolve()}\nEither remove the directory or choose a different destination directory or package name"
    email = arguments.maintainer_email or _git_email() or f"{arguments.maintainer_name}@todo.todo"
    _tell(arguments, folder, email)
    for path, text in _files(arguments, email).items():
        print(f"creating {Path('.') / folder / path}")
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    if arguments.license.startswith("TODO"):
        print("\n[WARNING]: Unknown license 'TODO: License declaration'.  This has been set in the package.xml, but no "
              "LICENSE file has been created.")  # fmt: skip
    return None


def _git_email() -> str:
    try:
        done = subprocess.run(["git", "config", "user.email"], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.strip()


def _tell(arguments: argparse.Namespace, folder: Path, email: str) -> None:
    print("going to create a new package")
    print(f"package name: {arguments.package_name}")
    print(f"destination directory: {folder.parent.resolve()}")
    print(f"package format: {arguments.package_format}")
    print("version: 0.0.0")
    print(f"description: {arguments.description}")
    print(f"maintainer: ['{arguments.maintainer_name} <{email}>']")
    print(f"licenses: ['{arguments.license}']")
    print(f"build type: {arguments.build_type}")
    print(f"dependencies: {arguments.dependencies}")
    if arguments.node_name:
        print(f"node_name: {arguments.node_name}")
    print(f"creating folder .{'/' + arguments.package_name if str(folder.parent) == '.' else ' ' + str(folder)}")


def _files(arguments: argparse.Namespace, email: str) -> dict[str, str]:
    name, node = arguments.package_name, arguments.node_name
    words = {
        "name": name,
        "description": arguments.description,
        "email": email,
        "maintainer": arguments.maintainer_name,
        "license": arguments.license,
        "dependencies": "".join(f"  <depend>{each}</depend>\n" for each in arguments.dependencies)
        + ("\n" if arguments.dependencies else ""),
        "scripts": f"\n            '{node} = {name}.{node}:main'" if node else "",
    }
    files = {
        "package.xml": PACKAGE_XML.substitute(words),
        "setup.py": SETUP_PY.substitute(words),
        "setup.cfg": SETUP_CFG.substitute(words),
        f"resource/{name}": "",
        f"{name}/__init__.py": "",
    }
    if node:
        files[f"{name}/{node}.py"] = NODE.substitute(words)
    return files
