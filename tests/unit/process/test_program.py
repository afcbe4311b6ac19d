"""A Python file or an entry point runs as the main program of a node process."""

from __future__ import annotations

import subprocess
import sys
import textwrap

import pytest
from bot_console.runtime.process import entry_point_program
from bot_console.runtime.process.crashes import explanation

RUN = """
import sys
from bot_console.runtime.process import entry_point_program, file_program
from bot_console.runtime.process.node.main_thread import exit_code_of
from bot_console.runtime.process.program import Places

sys.exit(exit_code_of({program}))
"""


def run(program, *argv):
    """Run a program, given as an expression, as the main program of a process."""
    words = [sys.executable, "-c", RUN.format(program=program), *argv]
    return subprocess.run(words, capture_output=True, text=True, timeout=240, check=False)


def run_file(path, *argv):
    return run(f"file_program({path!r})", *argv)


@pytest.fixture
def script(tmp_path):
    def write(text, name="node.py"):
        path = tmp_path / name
        path.write_text(textwrap.dedent(text))
        return str(path)

    return write


def test_file_runs_as_main_with_its_arguments(script):
    path = script("""
        import sys
        print(__name__, sys.argv[1:], sys.path[0] in __file__)
        if __name__ == '__main__':
            sys.exit(len(sys.argv))
    """)
    ended = run_file(path, "a", "b")
    assert (ended.stdout, ended.returncode) == ("__main__ ['a', 'b'] True\n", 3), ended.stderr


def test_traceback_shows_only_the_file(script):
    path = script("""
        def main():
            raise RuntimeError('no battery')
        main()
    """)
    lines = [line for line in run_file(path).stderr.splitlines(True) if line.strip(" ~^\n")]  # 3.13 underlines calls
    assert "".join(lines) == textwrap.dedent(f"""\
        Traceback (most recent call last):
          File "{path}", line 4, in <module>
            main()
          File "{path}", line 3, in main
            raise RuntimeError('no battery')
        RuntimeError: no battery
    """)


def test_syntax_error_is_printed_as_by_the_interpreter(script):
    path = script("x = = 1\n")
    ended = run_file(path)
    assert ended.returncode == 1
    lines = ended.stderr.splitlines()
    assert lines[0] == f'  File "{path}", line 1'
    assert lines[-1] == "SyntaxError: invalid syntax"


@pytest.mark.parametrize(
    ("entry_point", "message"),
    [
        ("entered_of_test:mian", "refers to mian() of entered_of_test, which does not exist; it has main."),
        ("entered_of_test.nope:main", "refers to the module entered_of_test.nope, which does not exist."),
        ("wants_of_test:main", None),
    ],
)
def test_invalid_entry_point_is_explained(tmp_path, monkeypatch, entry_point, message):
    (tmp_path / "entered_of_test.py").write_text("from textwrap import dedent\ndef main():\n    pass\n")
    (tmp_path / "wants_of_test.py").write_text("import nowhere_of_test\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises((AttributeError, ModuleNotFoundError)) as raised:
        entry_point_program(entry_point)()
    reported = explanation(raised.value)
    assert (reported is None) if message is None else (message in reported)


def test_missing_file_is_reported_as_by_the_interpreter(tmp_path):
    path = str(tmp_path / "no.py")
    ended = run_file(path)
    assert ended.returncode == 2
    assert ended.stderr == f"python3: can't open file {path!r}: [Errno 2] No such file or directory\n"


def test_dataclasses_and_type_hints_work_in_a_file(script):
    path = script("""
        from __future__ import annotations
        from dataclasses import dataclass, field
        from typing import ClassVar
        @dataclass
        class Pose:
            x: float = 0.0
            tags: list[str] = field(default_factory=list)
            frame: ClassVar[str] = 'map'
        print(Pose(1.0), Pose.frame)
    """)
    assert run_file(path).stdout == "Pose(x=1.0, tags=[]) map\n"


def test_file_is_main_in_sys_modules(script):
    path = script("""
        import sys, typing
        class Here: x: 'Here'
        print(sys.modules['__main__'].Here is Here, typing.get_type_hints(Here)['x'] is Here)
    """)
    assert run_file(path).stdout == "True True\n"


@pytest.mark.parametrize(("returned", "code", "err"), [("None", 0, ""), ("4", 4, ""), ("'sorry'", 1, "sorry\n")])
def test_return_value_of_an_entry_point_is_the_exit_code(script, tmp_path, returned, code, err):
    script(f"class App:\n    @staticmethod\n    def main():\n        return {returned}", "entry_of_test.py")
    ended = run(f"entry_point_program('entry_of_test:App.main', Places([{str(tmp_path)!r}]))")
    assert (ended.returncode, ended.stderr) == (code, err)


@pytest.mark.parametrize("entry_point", ["module", "module:", ":main", ""])
def test_malformed_entry_points_are_rejected(entry_point):
    with pytest.raises(ValueError, match="must have the form 'module:function'"):
        entry_point_program(entry_point)


def test_missing_function_of_an_entry_point_is_named(script, tmp_path):
    script("", "empty_of_test.py")
    ended = run(f"entry_point_program('empty_of_test:main', Places([{str(tmp_path)!r}]))")
    assert ended.stderr.splitlines(True)[-2] == "AttributeError: module 'empty_of_test' has no attribute 'main'\n"
