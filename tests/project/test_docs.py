"""The documents are correct: tables equal the code, links resolve, command lines are valid."""

import importlib.util
import re
import sys
from pathlib import Path

import pytest
from bot_console.runtime import rosidl

sys.path.insert(0, str(Path(__file__).parent))
from documented_commands import commands, fault

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def load_tool(name):
    spec = importlib.util.spec_from_file_location(f"documentation_{name}", ROOT / "tools" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


tables = load_tool("tables")
man_page = load_tool("man_page")
named = pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)


def text_of(path):
    return path.read_text(encoding="utf-8")


def anchors(path):
    """The anchors that a Markdown viewer gives to headings."""
    words = (re.sub(r"[`*]", "", each).strip().lower() for each in HEADING.findall(FENCED.sub("", text_of(path))))
    return {re.sub(r"[^\w -]", "", each).replace(" ", "-") for each in words}


@named
def test_tables_match_the_code(path):
    assert tables.fill_tables(text_of(path)) == text_of(path), "run: python tools/tables.py"


def test_manual_page_matches_the_options_and_commands():
    assert man_page.manual_page() == text_of(man_page.PAGE), "run: python tools/man_page.py"


def test_every_table_is_in_a_document():
    assert {name for path in DOCUMENTS for name in tables.table_names(text_of(path))} == set(tables.TABLES)


def test_changed_value_is_noticed():
    path = ROOT / "docs" / "parameters.md"
    wrong = text_of(path).replace("0.1 to 5 |", "0.1 to 6 |")
    assert wrong != text_of(path)
    assert tables.fill_tables(wrong) == text_of(path)


@named
def test_links_lead_somewhere(path):
    broken = []
    for target in LINK.findall(FENCED.sub("", text_of(path))):
        file, _, anchor = target.partition("#")
        if file.startswith("http"):
            continue
        there = (path.parent / file).resolve() if file else path
        if not there.exists() or (anchor and anchor not in anchors(there)):
            broken.append(target)
    assert not broken


@named
def test_command_lines_are_valid(path):
    faults = {line: wrong for line in commands(text_of(path)) if (wrong := fault(line))}
    assert not faults


@pytest.mark.parametrize(
    "line",
    [
        "bot-console --no-such-option",
        "bot-console nowhere",
        "bot-console launch bot_console_robot no_such.launch.py",
        "bot-console launch bot_console_robot robot_system.launch.py no_such_argument:=1",
        "bot-console no_such_argument:=1",
        "bot-console run --no-such-option",
        "ros2 param no_such_verb",
        "ros2 topic hz",
        "no-such-program",
        ".venv/bin/python tools/no_such.py",
        "bot-console export",
    ],
)
def test_invalid_command_line_is_noticed(line):
    assert fault(line)


def test_all_message_packages_are_named():
    row = next(line for line in text_of(ROOT / "docs" / "nodes-and-runtime.md").splitlines() if "std_msgs`" in line)
    generated = Path(rosidl.__file__).with_name("generated")
    packages = {each.parent.name for each in generated.glob("*/__init__.py")}
    assert set(re.findall(r"`(\w+)`", row)) == packages


def test_readme_links_to_every_document():
    linked = {each.partition("#")[0] for each in LINK.findall(text_of(ROOT / "README.md"))}
    assert {f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md")} <= linked


def test_files_to_open_first_exist():
    table = text_of(ROOT / "docs" / "contributing.md").partition("## Where would you change")[2].partition("\n## ")[0]
    places = re.findall(r"`([\w./]+/[\w./]*)`", table)
    assert len(places) >= 20
    assert [each for each in places if not (ROOT / each).exists()] == []


def test_pictures_are_small():
    pictures = list((ROOT / "docs" / "images").iterdir())
    assert pictures
    moving = {"tuning-loop.svg": 400_000}
    assert [each.name for each in pictures if each.stat().st_size >= moving.get(each.name, 150_000)] == []
