"""Templates for the manifest of a new package, and for the other files of a Python package."""

from __future__ import annotations

from string import Template

PACKAGE_XML = Template("""\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format$format.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="$format">
  <name>$name</name>
  <version>0.0.0</version>
  <description>$description</description>
  <maintainer email="$email">$maintainer</maintainer>
  <license>$license</license>

$buildtool$dependencies$tests  <export>
    <build_type>$build_type</build_type>
  </export>
</package>
""")
PYTHON_TESTS = """\
  <test_depend>ament_copyright</test_depend>
  <test_depend>ament_flake8</test_depend>
  <test_depend>ament_pep257</test_depend>
  <test_depend>python3-pytest</test_depend>

"""
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
    maintainer=$python_maintainer,
    maintainer_email=$python_email,
    description=$python_description,
    license=$python_license,
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
LINTER_TEST = Template("""\
import pytest

linter = pytest.importorskip('ament_$linter.main', reason='part of the ROS 2 development tools')


@pytest.mark.linter
def test_$linter():
    assert linter.main(argv=$argv) == 0
""")
LINTERS = {"copyright": "['.', 'test']", "flake8": "[]", "pep257": "['.', 'test']"}
"""ament's linters for a new package, with their arguments."""
