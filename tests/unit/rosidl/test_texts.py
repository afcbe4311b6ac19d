"""The included definition files, and those that are added."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
from bot_console.runtime.rosidl import sources, texts
from bot_console.runtime.rosidl.parse import parse
from bot_console.runtime.rosidl.write import to_text


def all_names() -> list[str]:
    return [f"{package}/{name}" for package in texts.standard_packages() for name in texts.interface_names(package)]


def test_every_file_defines_the_fields_of_its_class() -> None:
    for full_name in all_names():
        package, kind, name = full_name.split("/")
        interface = parse(texts.definition_text(package, kind, name) or "", package, kind, name)
        module = importlib.import_module(f"{package}.{kind}")
        for part in interface.parts:
            cls = getattr(module, part.name)
            assert {each.name: each.type.text for each in part.fields} == cls.get_fields_and_field_types(), full_name
            for constant in part.constants:
                assert repr(getattr(cls, constant.name)) == constant.value, full_name


def test_written_definitions_parse_as_the_same() -> None:
    for full_name in all_names():
        package, kind, name = full_name.split("/")
        interface = parse(texts.definition_text(package, kind, name) or "", package, kind, name)
        assert parse(to_text(interface), package, kind, name) == interface


def test_packages_and_interfaces_are_listed() -> None:
    assert {"std_msgs", "std_srvs", "rcl_interfaces", "tf2_msgs"} <= set(texts.known_packages())
    assert texts.interface_names("std_srvs") == ["srv/Empty", "srv/SetBool", "srv/Trigger"]
    assert texts.interface_names("nope_msgs") == []
    assert texts.definition_text("std_msgs", "msg", "Nope") is None
    assert texts.definition_text("nope_msgs", "msg", "Nope") is None


def test_comments_are_kept() -> None:
    assert "# Single scan from a planar laser range-finder" in (
        texts.definition_text("sensor_msgs", "msg", "LaserScan") or ""
    )


def test_other_packages_can_be_added(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "srv").mkdir()
    (tmp_path / "srv" / "Ask.srv").write_text("---\n")
    monkeypatch.setattr(sources, "_sources", [lambda: {"my_msgs": tmp_path}])
    assert "my_msgs" in texts.known_packages()
    assert texts.interface_names("my_msgs") == ["srv/Ask"]
    assert texts.definition_text("my_msgs", "srv", "Ask") == "---\n"


def test_definitions_of_a_machine_replace_the_included_ones(tmp_path: Path) -> None:
    (tmp_path / "share" / "arm_msgs" / "msg").mkdir(parents=True)
    (tmp_path / "share" / "arm_msgs" / "msg" / "Joint.msg").write_text("float64 angle\n")
    (tmp_path / "share" / "rcl").mkdir()
    texts.use_prefixes([tmp_path / "nowhere", tmp_path])
    try:
        assert texts.standard_packages() == ["arm_msgs"] and texts.package_folder("rcl") is None
        assert texts.interface_names("arm_msgs") == ["msg/Joint"] and texts.interface_names("tf2_msgs") == []
        assert texts.definition_text("arm_msgs", "msg", "Joint") == "float64 angle\n"
    finally:
        texts.use_prefixes([texts.PREFIX])
    assert "tf2_msgs" in texts.standard_packages()
