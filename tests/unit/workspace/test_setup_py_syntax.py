"""A mistake that keeps `setup.py` from running is reported with its line, although the package is still read."""

import ast

import pytest
from bot_console.runtime.workspace.setup_py import read_setup_py
from bot_console.runtime.workspace.setup_py_syntax import first_mistake

COURSE_LINE = "(os.path.join('share', package_name, 'config'), glob('config/*.yaml')),"
SETUP = f"""from setuptools import find_packages, setup

package_name = 'my_package'

setup(
    name=package_name,
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/' + package_name, ['package.xml']),
        {COURSE_LINE}
    ],
    entry_points={{'console_scripts': ['go = my_package.go:main']}},
)
"""


def test_missing_imports_are_reported_with_line_and_fix(tmp_path):
    (tmp_path / "setup.py").write_text(SETUP)
    read = read_setup_py(tmp_path)
    assert read.problem == f"{tmp_path / 'setup.py'}: line 10: name 'glob' is not defined; add `from glob import glob`"
    assert read.console_scripts == {"go": "my_package.go:main"}
    (tmp_path / "setup.py").write_text("from glob import glob\n" + SETUP)
    assert read_setup_py(tmp_path).problem.endswith("line 11: name 'os' is not defined; add `import os`")
    (tmp_path / "setup.py").write_text("import os\nfrom glob import glob\n" + SETUP)
    assert read_setup_py(tmp_path).problem == ""


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("setup(data_files=[\n  ('a', ['b'])\n  ('c', ['d'])])\ndef setup(**k): pass", "line 2: a comma is missing"),
        ("setup = print\nsetup(nmae)", "line 2: name 'nmae' is not defined"),
    ],
)
def test_first_mistake_is_reported(text, reported):
    assert first_mistake(ast.parse(text)).startswith(reported)


@pytest.mark.parametrize(
    "text",
    [
        "from setuptools import *\nsetup(x=find_packages())",
        "import os.path as path\nprint([each for each in path.sep if (n := each)], n)",
        "def run(*words, **kinds):\n    try:\n        return words, kinds\n    except OSError as e:\n        raise e",
        "f = lambda x: x\nclass C: pass\nprint(f, C, __file__, __name__)",
        "exec(open('version.py').read())\nprint(__version__)",
        "globals()['version'] = '1'\nprint(version)",
        "try:\n    unicode\nexcept NameError:\n    pass",
        "def run(words):\n    match words:\n        case [a, *b]: return a, b\n        case {'c': 1, **d}: return d\n"
        "        case _ as e: return e",
        "from __future__ import annotations\ndef f(x: Path) -> Path:\n    y: Path = x\n    return y",
        "class C:\n    name = __qualname__\n    def f(self): return __class__",
    ],
)
def test_valid_files_have_no_mistake(text):
    assert first_mistake(ast.parse(text)) == ""
