"""The index of installed packages. Contract, section 1.6."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest
from ament_index_python import (
    InvalidResourceNameError,
    InvalidResourceTypeNameError,
    get_resource,
    get_resource_types,
    get_resources,
    has_resource,
)
from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_package_share_path,
    get_packages_with_prefixes,
)
from bot_console.runtime.workspace import discover


@pytest.fixture
def prefixes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Two prefixes: the first has `both`, the second `both` and `second`."""
    found = [tmp_path / "first", tmp_path / "second"]
    for prefix, names in zip(found, (["both"], ["both", "second"]), strict=True):
        index = prefix / "share" / "ament_index" / "resource_index" / "packages"
        index.mkdir(parents=True)
        for name in names:
            (index / name).write_text(f"{name} of {prefix.name}")
    (found[0] / "share" / "both").mkdir()
    monkeypatch.setenv("AMENT_PREFIX_PATH", ":".join(map(str, [*found, tmp_path / "none"])))
    return found


def test_first_prefix_takes_precedence(prefixes: list[Path]) -> None:
    first, second = map(str, prefixes)
    assert get_package_prefix("both") == first
    assert get_package_prefix("second") == second
    assert get_packages_with_prefixes()["both"] == first
    assert get_package_share_directory("both") == f"{first}/share/both"
    assert get_package_share_path("both") == prefixes[0] / "share" / "both"


def test_missing_share_folder_is_only_a_warning(prefixes: list[Path]) -> None:
    with pytest.warns(UserWarning, match="does not exist"):
        assert get_package_share_directory("second") == f"{prefixes[1]}/share/second"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        get_package_share_directory("second", print_warning=False)


def test_unknown_package_error_lists_searched_prefixes(prefixes: list[Path]) -> None:
    with pytest.raises(PackageNotFoundError) as caught:
        get_package_prefix("nopkg")
    assert isinstance(caught.value, KeyError)
    assert str(caught.value) == f"\"package 'nopkg' not found, searching: {[str(each) for each in prefixes]}\""


def test_error_without_prefixes_lists_workspace_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setattr(discover, "_current", [discover.Workspace([tmp_path])])
    with pytest.raises(PackageNotFoundError) as caught:
        get_package_prefix("nopkg")
    assert str(caught.value) == f"\"package 'nopkg' not found, searching: ['{tmp_path}']\""


@pytest.mark.parametrize("name", ["./x.launch.py", "a/b", "", "a b"])
def test_invalid_package_name_is_rejected(name: str) -> None:
    with pytest.raises(ValueError, match="is not a valid package name"):
        get_package_prefix(name)


def test_resources_are_found_by_type_and_name(prefixes: list[Path]) -> None:
    first, second = map(str, prefixes)
    assert get_resource("packages", "both") == ("both of first", first)
    assert get_resources("packages") == {"both": first, "second": second}
    assert has_resource("packages", "second") == second
    assert not has_resource("packages", "none")
    assert get_resource_types() == {"packages"}
    with pytest.raises(LookupError):
        get_resource("packages", "none")


@pytest.mark.parametrize("name", ["a/b", "..\\x"])
def test_resource_names_with_path_separators_are_rejected(name: str) -> None:
    with pytest.raises(InvalidResourceTypeNameError):
        get_resources(name)
    with pytest.raises(InvalidResourceNameError):
        get_resource("packages", name)
    assert issubclass(InvalidResourceTypeNameError, ValueError) and issubclass(InvalidResourceNameError, ValueError)


def test_empty_resource_names_are_rejected() -> None:
    for ask in (lambda: get_resource("", "name"), lambda: get_resources(""), lambda: has_resource("", "name")):
        with pytest.raises(AssertionError, match=r"^The resource type must not be empty"):
            ask()
    with pytest.raises(AssertionError, match=r"^The resource name must not be empty"):
        get_resource("packages", "")


def test_resource_index_subfolder_is_upstreams() -> None:
    import ament_index_python

    assert ament_index_python.RESOURCE_INDEX_SUBFOLDER == "share/ament_index/resource_index"
