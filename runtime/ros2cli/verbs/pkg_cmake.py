"""The files that `pkg create` writes for CMake packages; those of interface packages work here without a build."""

from __future__ import annotations

from collections.abc import Mapping

from ros2cli.verbs import pkg_cmake_templates as texts
from ros2cli.verbs.pkg_templates import PACKAGE_XML


def files(
    words: Mapping[str, str], build_type: str, dependencies: list[str], node: str, library: str
) -> dict[str, str]:
    """Return the files' contents by path in the package, in order; `words` are the template values of `pkg create`."""
    name, ament = words["name"], build_type == "ament_cmake"
    buildtool = ("ament_cmake_ros" if library else "ament_cmake") if ament else ""
    found = [*(["ament_cmake"] if ament else []), *([buildtool] if ament and library else []), *dependencies]
    filled = {
        **words,
        "buildtool": f"  <buildtool_depend>{buildtool}</buildtool_depend>\n\n" if ament else "",
        "build_type": build_type,
        "tests": texts.LINTERS if ament else "",
    }
    made = {"package.xml": PACKAGE_XML.substitute(filled)}
    more = {
        "name": name,
        "macro": name.upper(),
        "node": node,
        "library": library,
        "kind": "" if ament else "SHARED ",  # ament_cmake_ros builds shared libraries by default
        "class_name": "".join(each.capitalize() for each in library.split("_")),
        "guard": f"{name}__{library}".upper(),
        "find": "".join(f"find_package({each} REQUIRED)\n" for each in found)
        if dependencies or ament
        else texts.NO_FIND,
        "again": "".join(f"find_dependency({each})\n" for each in dependencies),
        "use": _link_lines(ament, library, dependencies),
        "node_use": _link_lines(ament, node, dependencies),
        "link": f"target_link_libraries({node} {library})\n" if library else "",
    }
    made["CMakeLists.txt"] = _cmake_lists(more, ament, node, library)
    if not ament:
        made[f"{name}Config.cmake.in"] = (texts.CONFIG + (texts.CONFIG_TARGETS if library else "")).format(**more)
        made[f"{name}ConfigVersion.cmake.in"] = texts.CONFIG_VERSION
    if node:
        made[f"src/{node}.cpp"] = texts.NODE_CPP.substitute(more)
    if library:
        made[f"include/{name}/{library}.hpp"] = texts.LIBRARY_HPP.substitute(more)
        made[f"src/{library}.cpp"] = texts.LIBRARY_CPP.substitute(more)
        made[f"include/{name}/visibility_control.h"] = texts.VISIBILITY.substitute(more)
    return made


def _cmake_lists(words: Mapping[str, str], ament: bool, node: str, library: str) -> str:
    include = "include/${PROJECT_NAME}" if ament else "include"
    parts = [texts.HEAD.substitute(words)]
    if library:
        parts.append(texts.LIBRARY.substitute(words, include=include))
    if node:
        parts.append(texts.NODE.substitute(words, include=include))
    if ament:
        parts += [texts.AMENT_TESTS, *([texts.AMENT_EXPORTS.substitute(words)] if library else []), texts.AMENT_END]
    else:
        parts += [*([texts.EXPORT] if library else []), texts.CONFIG_INSTALL]
    return "\n".join(parts)


def _link_lines(ament: bool, target: str, dependencies: list[str]) -> str:
    """Return the lines that link a target to the dependencies; empty for plain CMake: target names are unknown."""
    if not ament or not dependencies:
        return ""
    lines = "\n".join(f'  "{each}"' for each in dependencies)
    return f"ament_target_dependencies(\n  {target}\n{lines}\n)\n"
