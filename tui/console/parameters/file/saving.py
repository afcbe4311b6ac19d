"""Saves parameters as standard ROS parameter files; an existing file is patched, so that its comments stay."""

from __future__ import annotations

import codecs
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Value
from bot_console.tui.console.parameters.file.patch import Values, compare, patched
from bot_console.tui.console.parameters.file.text import SMALLEST, sections
from bot_console.tui.files.save_file import NotSaved, save_file

BUILT_IN = ("use_sim_time", "start_type_description_service")
_MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))
"""The byte order marks that YAML parsers recognise, and their encodings."""


@dataclass(frozen=True)
class SaveResult:
    """The number of saved parameters, and those that a parameter file cannot contain, with the reason."""

    count: int
    left_out: tuple[str, ...] = ()

    def text(self, path: Path) -> str:
        """A summary for the user."""
        reported = f"{self.count} parameter{'' if self.count == 1 else 's'} saved to {path}"
        return reported + "".join(f"; left out: {each}" for each in self.left_out)


def save(
    path: Path,
    trees: Mapping[str, ParameterTree],
    nodes: tuple[str, ...] = (),
    *,
    only_changed: bool = False,
    all_of_them: bool = False,
    title: str = "",
) -> SaveResult:
    """Write the parameters of some nodes (default: all); raises `NotSaved`, in which case the file is unchanged.

    `only_changed` restricts them to those that differ from their declared value or, if that is unknown, from their
    start value. `all_of_them` includes built-in ones and those that cannot be set in a running node. `title` is a
    comment line at the beginning of a new file.

    In an existing file, values are replaced in place and new ones are added.
    """
    values: dict[str, dict[str, Value]] = {}
    left_out: list[str] = []
    for tree in trees.values():
        for each in tree.parameters if not nodes or tree.node in nodes else ():
            left = not all_of_them and (each.name in BUILT_IN or each.read_only or (only_changed and not each.changed))
            if each.value is None or left:
                continue
            if reason := _unwritable(each):
                left_out.append(f"{each.node} {each.name} {reason}")
            else:
                values.setdefault(tree.node, {})[each.name] = each.value
    if not values:
        raise NotSaved("there are no parameters to save" + "".join(f"; {each}" for each in left_out))
    _write(path, values, title)
    return SaveResult(sum(map(len, values.values())), tuple(left_out))


def _unwritable(parameter: ParameterInfo) -> str:
    if parameter.kind is Kind.BYTE_ARRAY:
        return "is a byte array, which ROS parameter files cannot hold"
    if parameter.value == ():
        return "is an empty array, to which ROS parameter files give no type"
    numbers = parameter.value if isinstance(parameter.value, tuple) else (parameter.value,)
    tiny = any(isinstance(each, float) and 0 < abs(each) < SMALLEST for each in numbers)
    return "is too close to zero for the readers of ROS parameter files" if tiny else ""


def _write(path: Path, values: Values, title: str) -> None:
    try:
        content = path.read_bytes() if path.is_file() else b""
    except OSError as error:
        raise NotSaved(f"{path}: cannot be read: {error.strerror}") from error
    try:
        mark, encoding, text = _decode(content)
        before = sections(text)
        new = mark + patched(text or title, values).encode(encoding)
        save_file(path, new, lambda written: compare(before, sections(_decode(written)[2]), values))
    except ValueError as error:
        why = "it is not a text file" if isinstance(error, UnicodeDecodeError) else str(error)
        raise NotSaved(
            f"parameters cannot be added to {path}: {why}; give another name, such as {_free_name(path)}"
        ) from None


def _decode(content: bytes) -> tuple[bytes, str, str]:
    """The byte order mark of a file, the encoding, and the text after the mark; raises `UnicodeDecodeError`."""
    mark, encoding = next((each for each in _MARKS if content.startswith(each[0])), (b"", "utf-8"))
    return mark, encoding, content[len(mark) :].decode(encoding)


def _free_name(path: Path) -> str:
    """An unused file name in the same folder."""
    names = (path.with_name(f"{path.stem}-parameters{number}.yaml") for number in ("", *map(str, range(2, 1000))))
    try:
        return next((str(each) for each in names if not each.exists()), "another folder")
    except OSError:  # the name already has the maximum length
        return "a shorter one"
