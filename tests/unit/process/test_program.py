"""A Python file or an entry point runs as the main program of a node process."""

from __future__ import annotations

import sys
import textwrap

import pytest
from bot_console.runtime.process import entry_point_program, file_program
from bot_console.runtime.process.crashes import explanation
from bot_console.runtime.process.virtual.fresh_import import FreshModules


@pytest.fixture
def script(tmp_path):
    def write(text, name="node.py"):
        path = tmp_path / name
        path.write_text(textwrap.dedent(text))
        return str(path)

    return write


def test_file_runs_as_main_with_its_arguments(run, script):
    path = script("""
        import sys
        print(__name__, __file__ == sys.argv[0], sys.argv[1:], sys.path[0] in __file__)
        if __name__ == '__main__':
            sys.exit(len(sys.argv))
    """)
    ended = run(file_program(path), argv=[path, "a", "b"])
    assert ended.stdout == "__main__ True ['a', 'b'] True\n"
    assert ended.process.exit_code == 3


def test_modules_beside_the_file_are_fresh_for_each_run(run, script):
    script("value = []", "helper_of_test.py")
    path = script("""
        import helper_of_test
        helper_of_test.value.append(1)
        print(helper_of_test.value)
    """)
    for _ in range(2):
        assert run(file_program(path)).stdout == "[1]\n"


def test_folders_added_to_sys_path_are_fresh_for_each_run(run, script, tmp_path):
    (tmp_path / "lib").mkdir()
    script("value = []", "lib/library_of_test.py")
    path = script("""
        import os, sys
        try:
            import library_of_test
        except ImportError:
            sys.path.append(os.path.join(os.path.dirname(__file__), 'lib'))
        import library_of_test
        library_of_test.value.append(1)
        print(library_of_test.value)
    """)
    before = list(sys.path)
    for _ in range(2):
        assert run(file_program(path)).stdout == "[1]\n"
    assert sys.path == before


def test_traceback_shows_only_the_file(run, script):
    path = script("""
        def main():
            raise RuntimeError('no battery')
        main()
    """)
    lines = [line for line in run(file_program(path)).err if line.strip(" ~^\n")]  # 3.13 underlines calls
    assert "".join(lines) == textwrap.dedent(f"""\
        Traceback (most recent call last):
          File "{path}", line 4, in <module>
            main()
          File "{path}", line 3, in main
            raise RuntimeError('no battery')
        RuntimeError: no battery
    """)


def test_traceback_shows_the_lines_of_an_edited_file(run, script):
    run(file_program(script("raise ValueError('first')")))
    ended = run(file_program(script("x = 1\nraise ValueError('second')")))
    assert "raise ValueError('second')" in ended.stderr


def test_syntax_error_is_printed_as_by_the_interpreter(run, script):
    path = script("x = = 1\n")
    ended = run(file_program(path))
    assert ended.process.exit_code == 1
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
        entry_point_program(entry_point, FreshModules())()
    reported = explanation(raised.value)
    assert (reported is None) if message is None else (message in reported)


def test_missing_file_is_reported_as_by_the_interpreter(run, tmp_path):
    path = str(tmp_path / "no.py")
    ended = run(file_program(path))
    assert ended.process.exit_code == 2
    assert ended.stderr == f"python3: can't open file {path!r}: [Errno 2] No such file or directory\n"


def test_exit_functions_of_the_file_run_at_its_end(run, script):
    path = script("""
        import atexit
        atexit.register(print, 'first')
        atexit.register(print, 'second')
        never = lambda: print('never')
        atexit.register(never)
        atexit.unregister(never)
        print('main')
    """)
    assert run(file_program(path)).stdout == "main\nsecond\nfirst\n"


def test_dataclasses_and_type_hints_work_in_a_file(run, script):
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
    assert run(file_program(path)).stdout == "Pose(x=1.0, tags=[]) map\n"


def test_file_finds_itself_and_its_modules_in_sys_modules(run, script):
    script("value = 1", "sibling_of_test.py")
    path = script("""
        import sys, json, sibling_of_test, typing
        class Here: x: 'Here'
        print(sys.modules['__main__'].Here is Here, sys.modules['sibling_of_test'] is sibling_of_test)
        print(sys.modules.get('json') is json, 'sibling_of_test' in sys.modules, 'nonsense' in sys.modules)
        print(typing.get_type_hints(Here)['x'] is Here)
        print(len(sys.modules) == len(list(sys.modules)) == len(sys.modules.copy()))
    """)
    assert run(file_program(path)).out == ["True True\n", "True True False\n", "True\n", "True\n"]
    assert "sibling_of_test" not in sys.modules


@pytest.mark.parametrize(("returned", "code", "err"), [("None", 0, ""), ("4", 4, ""), ("'sorry'", 1, "sorry\n")])
def test_return_value_of_an_entry_point_is_the_exit_code(run, script, tmp_path, returned, code, err):
    script(f"class App:\n    @staticmethod\n    def main():\n        return {returned}", "entry_of_test.py")
    ended = run(entry_point_program("entry_of_test:App.main", FreshModules([str(tmp_path)])))
    assert (ended.process.exit_code, ended.stderr) == (code, err)


@pytest.mark.parametrize("entry_point", ["module", "module:", ":main", ""])
def test_malformed_entry_points_are_rejected(entry_point):
    with pytest.raises(ValueError, match="must have the form 'module:function'"):
        entry_point_program(entry_point)


def test_missing_function_of_an_entry_point_is_named(run, script, tmp_path):
    script("", "empty_of_test.py")
    ended = run(entry_point_program("empty_of_test:main", FreshModules([str(tmp_path)])))
    assert ended.err[-2] == "AttributeError: module 'empty_of_test' has no attribute 'main'\n"
