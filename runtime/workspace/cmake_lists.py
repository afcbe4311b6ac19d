"""Reads which Python programs and files a `CMakeLists.txt` installs, without running CMake.

It understands `project`, `set`, `file(GLOB)`, `ament_python_install_package`, and `install` of PROGRAMS, FILES and
DIRECTORY; `${NAME}` is replaced by the value set above. Everything else is ignored, such as conditions and compiled
programs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from bot_console.runtime.workspace.setup_py import SetupFile

_COMMENT = re.compile(r'("[^"]*")|#[^\n]*')
_COMMAND = re.compile(r"\b(\w+)\s*\(([^()]*)\)")
_WORD = re.compile(r'"([^"]*)"|(\S+)')
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_PROGRAMS, _FILES, _DIRECTORY = "PROGRAMS", "FILES", "DIRECTORY"
_KEYWORDS = frozenset(
    {
        "CONFIGURATIONS",
        "DESTINATION",
        "EXCLUDE",
        "FILES_MATCHING",
        "OPTIONAL",
        "PATTERN",
        "PERMISSIONS",
        "RENAME",
        "USE_SOURCE_PERMISSIONS",
    }
)


def read_cmake_lists(folder: Path) -> SetupFile:
    """Read the `CMakeLists.txt` of a package folder; raises `ValueError` if it cannot be read."""
    try:
        text = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{folder / 'CMakeLists.txt'}: {error}") from None
    reader = _Reader(folder)
    for command, words in _commands(_COMMENT.sub(lambda found: found[1] or "", text), reader.variables):
        reader.take(command, words)
    return SetupFile({}, reader.scripts, reader.modules, tuple(reader.data_files))


def _commands(text: str, variables: Mapping[str, list[str]]) -> Iterator[tuple[str, list[str]]]:
    """Yield each command with its arguments; a variable that is a whole argument expands to all its values."""
    for name, inside in _COMMAND.findall(text):
        words: list[str] = []
        for quoted, bare in _WORD.findall(inside):
            alone = _VARIABLE.fullmatch(bare)
            if alone:
                words += variables.get(alone[1], [])
            else:
                words.append(_VARIABLE.sub(lambda found: ";".join(variables.get(found[1], [])), quoted or bare))
        yield name.lower(), words


class _Reader:
    """The variables and installed files of the commands read so far."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._name = folder.name
        here = [str(folder)]
        self.variables: dict[str, list[str]] = {"CMAKE_CURRENT_SOURCE_DIR": here, "CMAKE_SOURCE_DIR": here}
        self.scripts: dict[str, Path] = {}
        self.modules: dict[str, Path] = {}
        self.data_files: list[tuple[str, tuple[Path, ...]]] = []

    def take(self, command: str, words: list[str]) -> None:
        """Process one command."""
        if command == "project" and words:
            self._name = words[0]
            self.variables["PROJECT_NAME"] = words[:1]
            self.data_files.append((f"share/{self._name}", (self._folder / "package.xml",)))
        elif command == "set" and words:
            self.variables[words[0]] = words[1:]
        elif command == "file" and len(words) > 2 and words[0] in ("GLOB", "GLOB_RECURSE"):
            self._glob(words[1], [word for word in words[2:] if word != "CONFIGURE_DEPENDS"])
        elif command == "ament_python_install_package" and words:
            self._install_package(words)
        elif command == "install" and "DESTINATION" in words[:-1] and words[0] in (_PROGRAMS, _FILES, _DIRECTORY):
            self._install(words)

    def _glob(self, variable: str, words: list[str]) -> None:
        base = self._folder
        if words[:1] == ["RELATIVE"]:
            base, words = self._folder / words[1], words[2:]
        patterns = [word.removeprefix(f"{base}/") for word in words if word.startswith(str(base)) or word[:1] != "/"]
        self.variables[variable] = [str(path) for each in patterns for path in sorted(base.glob(each))]

    def _install_package(self, words: list[str]) -> None:
        given = dict(zip(words[1::2], words[2::2], strict=False))
        folder = self._folder / given.get("PACKAGE_DIR", words[0])
        if folder.is_dir():
            self.modules[words[0]] = folder

    def _install(self, words: list[str]) -> None:
        """Process `install(KIND path... DESTINATION place [RENAME name] ...)`."""
        end = next(index for index, word in enumerate(words) if index and word in _KEYWORDS)
        place = words[words.index("DESTINATION") + 1].rstrip("/")
        sources = [(word, self._folder / word) for word in words[1:end] if word]
        if words[0] == _DIRECTORY:
            for written, path in sources:
                self._install_tree(path, place if written.endswith("/") else f"{place}/{path.name}")
        elif place == f"lib/{self._name}":
            renamed = words[words.index("RENAME") + 1] if "RENAME" in words[:-1] else ""
            self.scripts.update({renamed or path.name: path for _, path in sources if path.is_file()})
        else:
            self.data_files.append((place, tuple(path for _, path in sources)))

    def _install_tree(self, source: Path, place: str) -> None:
        if place == f"lib/{self._name}":
            self.scripts.update({path.name: path for path in sorted(source.glob("*")) if path.is_file()})
            return
        folders: dict[str, list[Path]] = {}
        for path in sorted(source.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                inner = path.parent.relative_to(source).as_posix()
                folders.setdefault(place if inner == "." else f"{place}/{inner}", []).append(path)
        self.data_files += [(folder, tuple(paths)) for folder, paths in folders.items()]
