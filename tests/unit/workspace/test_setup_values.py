"""Values in `setup.py` are evaluated without running it; a value that cannot be evaluated is reported."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from bot_console.runtime.workspace import setup_py
from bot_console.runtime.workspace.setup_py import read_setup_py

ABOVE = """\
import os
from glob import glob
from pathlib import Path
from setuptools import setup
nodes = ['talk', 'listen']
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    (tmp_path / "mine").mkdir()
    for name in ("__init__", "listen", "talk"):
        (tmp_path / "mine" / f"{name}.py").write_text("")
    return tmp_path


@pytest.mark.parametrize(
    "scripts",
    [
        "[f'{each} = mine.{each}:main' for each in nodes]",
        "['{0} = mine.{0}:main'.format(each) for each in nodes]",
        "['%s = mine.%s:main' % (each, each) for each in nodes]",
        "[f'{p[5:-3]} = mine.{p[5:-3]}:main' for p in glob('mine/*.py') if '__' not in p]",
        "[f'{os.path.basename(p)[:-3]} = mine.' + os.path.splitext(os.path.basename(p))[0] + ':main'"
        " for p in glob('mine/*.py') if not p.endswith('__init__.py')]",
        "[f'{Path(p).stem} = mine.{Path(p).stem}:main' for p in glob('mine/*.py') if Path(p).stem != '__init__']",
        "'\\n'.join(each + ' = mine.' + each + ':main' for each in nodes)",
        "[each.strip() for each in 'talk = mine.talk:main, listen = mine.listen:main'.split(',')]",
    ],
)
def test_computed_entry_points_are_found(package: Path, scripts: str) -> None:
    (package / "setup.py").write_text(f"{ABOVE}setup(name='mine', entry_points={{'console_scripts': {scripts}}})\n")
    found = read_setup_py(package)
    assert (found.console_scripts, found.problem) == ({"talk": "mine.talk:main", "listen": "mine.listen:main"}, "")


@pytest.mark.parametrize("scripts", ["[open('x').read()]", "[nodes[7]]", "['{:>9999999999}'.format(1)]", "[-nodes[0]]"])
def test_entry_points_that_need_execution_are_reported_with_line_and_fix(package: Path, scripts: str) -> None:
    (package / "setup.py").write_text(f"{ABOVE}setup(name='mine', entry_points={{'console_scripts': {scripts}}})\n")
    problem = read_setup_py(package).problem
    assert "line 6: " in problem and "Write them out" in problem


@pytest.mark.parametrize("fault", [MemoryError(), RecursionError()], ids=["MemoryError", "RecursionError"])
def test_setup_py_that_is_nested_too_deeply_is_refused(
    package: Path, fault: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Which of these errors Python's parser raises, and at what depth, depends on its version."""

    def parse(text: str) -> ast.Module:
        raise fault

    (package / "setup.py").write_text("[[[]]]")
    monkeypatch.setattr(setup_py.ast, "parse", parse)
    with pytest.raises(ValueError, match="nested too deeply"):
        read_setup_py(package)
