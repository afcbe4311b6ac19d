"""Checks whether a condition holds, and says what is missing if not, in the texts of `lint` and the runtime's hints."""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from bot_console.runtime.programs import hints
from bot_console.tui.cli.lint.run import lint_files
from bot_console.tui.console.parameters.file.text import sections
from bot_console.tui.console.parameters.file.yaml_tree import Scalar
from bot_console.tui.console.parameters.file.yaml_tree import Sequence as YamlSequence
from bot_console.tui.learn.activity import Activity, LaunchRecord, parameter_names
from bot_console.tui.learn.condition_syntax import Condition
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.wording import command_text, launch_text, node_text, pane_text
from bot_console.tui.text.value_text import value_text

NO_PACKAGE = "there is no package yet: a folder with package.xml and setup.py"


def missing(
    condition: Condition,
    activity: Activity,
    files: WorkspaceFiles,
    names: dict[str, str],
    *,
    driven_before: float = 0.0,
) -> str:
    """What is missing, in a sentence; empty if the condition holds. Names that `as` introduces are added to `names`.

    `driven_before` is the distance (m) that does not count, since the robot drove it before the step asked for it.
    """
    words = [with_names(each, names) for each in condition.words]
    if condition.verb == "saw-node":
        return _node(words, activity, names)
    if condition.verb == "saw-move":
        return _move(words, activity.metres - driven_before)
    if condition.once:
        return _ACTIVITY_CHECKS[condition.verb](words, activity)
    return _FILE_CHECKS[condition.verb](words, files)


def with_names(text: str, names: Mapping[str, str]) -> str:
    """The text with `{name}` replaced by the value of the name; other braces are kept."""
    for name, value in names.items():
        text = text.replace(f"{{{name}}}", value)
    return text


def _node(words: Sequence[str], activity: Activity, names: dict[str, str]) -> str:
    given = dict(zip(words[1::2], words[2::2], strict=True))
    wanted, parameter = words[0], given.get("with", "")
    found = [each for each in sorted(activity.nodes) if wanted == "*" or each.lstrip("/") == wanted.lstrip("/")]
    having = [each for each in found if not parameter or (each, parameter) in activity.parameters]
    if having:
        if "as" in given:
            names[given["as"]] = having[-1].lstrip("/")
        return ""
    if found:
        declared = parameter_names({key: at for key, at in activity.parameters.items() if key[0] in found})
        near = hints.did_you_mean(parameter, declared)
    else:
        nodes = [each.lstrip("/") for each in activity.nodes]
        near = "" if wanted == "*" else hints.did_you_mean(wanted.lstrip("/"), nodes)
    return f"waiting for: {node_text(wanted, parameter)}{near}"


def _parameter(words: Sequence[str], activity: Activity) -> str:
    name, wanted = words[0], words[words.index("==") + 1] if "==" in words else None
    found = activity.parameters_named(name)
    if not found:
        near = hints.did_you_mean(name, parameter_names(activity.parameters))
        return f"waiting for: a node with a parameter {name}{near}"
    if "described" in words and not any(each.description for each in found):
        return f"{name} has no description: give declare_parameter a ParameterDescriptor(description=...)"
    if "limited" in words and not any(each.range for each in found):
        return f"{name} has no range: give its ParameterDescriptor a floating_point_range or an integer_range"
    if wanted is not None and not any(value_text(each.value) == wanted for each in found):
        return f"waiting for: {name} with the value {wanted}; it is {value_text(found[-1].value)}"
    return ""


def _set(words: Sequence[str], activity: Activity) -> str:
    values, reasons = activity.set_values(words[0]), activity.refusals(words[0])
    if any(len(words) == 1 or _equal(each, words[1]) for each in values):
        return ""
    other = f"; it was set to {values[-1]}" if values else f"; a value was refused: {reasons[-1]}" if reasons else ""
    asked = f"{words[0]} to be set to {words[1]}" if len(words) > 1 else f"somebody to set {words[0]}"
    return f"waiting for: {asked}{other}"


def _equal(one: str, other: str) -> bool:
    try:
        return float(one) == float(other)
    except ValueError:
        return one.strip("'\"") == other.strip("'\"")


def _refused(words: Sequence[str], activity: Activity) -> str:
    reasons = activity.refusals(words[0])
    if any(len(words) == 1 or words[1].lower() in each.lower() for each in reasons):
        return ""
    asked = f"waiting for: a value of {words[0]} that is refused"
    if len(words) > 1:
        return f"{asked} with the reason '{words[1]}'{f', not: {reasons[-1]}' if reasons else ''}"
    accepted = activity.set_values(words[0])
    how = "a callback refuses it by SetParametersResult(successful=False, ...)"
    return f"{asked}; {accepted[-1]} was accepted: {how}" if accepted else asked


def _command(words: Sequence[str], activity: Activity) -> str:
    ran = [each for each in activity.commands if _in_order(words, each.words)]
    if any(each.is_working for each in ran):
        return ""
    failed = f"; it ended with exit code {ran[-1].code}" if ran and ran[-1].failed else ""
    return f"waiting for: the command {command_text(words)}{failed}"


def _failure(words: Sequence[str], activity: Activity) -> str:
    ran = [each for each in activity.commands if _in_order(words, each.words)]
    if any(each.failed for each in ran):
        return ""
    went_on = "; it did not fail" if any(each.is_working for each in ran) else ""
    return f"waiting for: the command {command_text(words)}, to see it fail{went_on}"


def _in_order(wanted: Sequence[str], given: Sequence[str]) -> bool:
    left = iter(given)
    return all(any(fnmatch.fnmatch(each, want) for each in left) for want in wanted)


def _launch(words: Sequence[str], activity: Activity) -> str:
    file, rest = words[0], words[1:]
    argument = next((each for each in rest[:1] if ":=" in each), "")
    text = rest[-1] if "contains" in rest else ""
    ran = [each for each in activity.launches if fnmatch.fnmatch(f"/{each.file}", f"*/{file}")]
    passed = [each for each in ran if not argument or _in_order([argument], _command_words(each, activity))]
    having = [each for each in passed if text in each.text]
    if any(each.command < 0 or activity.commands[each.command].is_working for each in having):
        return ""
    if any(activity.commands[each.command].failed for each in having):
        return f"waiting for: a launch of {having[-1].file} that does not fail"
    asked = f"waiting for: a launch of {launch_text(file, argument, text)}"
    return f"{asked}; {passed[-1].file} had no {text} when it was launched" if passed and not having else asked


def _command_words(launches: LaunchRecord, activity: Activity) -> Sequence[str]:
    return activity.commands[launches.command].words if launches.command >= 0 else ()


def _move(words: Sequence[str], driven: float) -> str:
    left = float(words[0]) - driven
    return "" if left <= 0 else f"waiting for: the robot to drive {left:.1f} m"


def _any_of(what: str, of: Callable[[Activity], set[str]]) -> Callable[[Sequence[str], Activity], str]:
    def judge(words: Sequence[str], activity: Activity) -> str:
        found = of(activity)
        held = bool(found) if words[0] == "*" else any(fnmatch.fnmatch(each, words[0]) for each in found)
        return "" if held else f"waiting for: {what.format('' if words[0] == '*' else words[0]).rstrip()}"

    return judge


_ACTIVITY_CHECKS: Mapping[str, Callable[[Sequence[str], Activity], str]] = {
    "saw-parameter": _parameter,
    "saw-set": _set,
    "saw-refused": _refused,
    "saw-command": _command,
    "saw-failure": _failure,
    "saw-launch": _launch,
    "saw-topic": _any_of("topic {}", lambda activity: activity.topics),
    "saw-pane": lambda words, activity: (
        "" if fnmatch.filter(activity.panes, words[0]) else f"waiting for: {pane_text(words[0])}"
    ),
    "saw-curve": lambda words, activity: (
        "" if any(words[0] in each for each in activity.curves) else f"waiting for: a curve of {words[0]} in the plot"
    ),
    "saw-layout": _any_of("a saved layout {}", lambda activity: activity.layouts),
    "saw-profile": _any_of(
        "a profile {} to be applied", lambda activity: activity.profiles | activity.arguments_of_up()
    ),
    "saw-steering": lambda words, activity: (
        "" if activity.steered else "waiting for: the robot to be driven by your keys"
    ),
}


def _file(words: Sequence[str], files: WorkspaceFiles) -> str:
    found = files.matching(words[0])
    if not found:
        return f"there is no file {words[0]} in {files.folder}"
    having = [each for each in found if words[2:] and words[2] in files.text(each)]
    if words[1:2] == ["lacks"]:
        return f"{files.relative_path(having[0])} still has {words[2]}" if having else ""
    if len(words) == 1 or having:
        return ""
    return f"{files.relative_path(files.newest(found))} has no {words[2]}"


def _entry_point(words: Sequence[str], files: WorkspaceFiles) -> str:
    packages = files.packages
    if not packages:
        return NO_PACKAGE
    for each in packages:
        if words[0] in each.executables or (words[0] == "*" and each.executables):
            return ""
    if packages[0].problem:
        return packages[0].problem
    what = "console script" if words[0] == "*" else f"line for {words[0]}"
    near = hints.did_you_mean(words[0], packages[0].executables)
    return f"{files.relative_path(packages[0].folder / 'setup.py')} has no {what} in console_scripts{near}"


def _installed(words: Sequence[str], files: WorkspaceFiles) -> str:
    folders = [each.folder.resolve() for each in files.packages]
    wanted = [each for each in files.matching(words[0]) if any(each.resolve().is_relative_to(one) for one in folders)]
    if not wanted:
        return f"there is no file {words[0]} in a package"
    for package in files.packages:
        installed = {each.resolve() for _, sources in package.data_files for each in sources}
        wanted = [each for each in wanted if each.resolve() not in installed]
    if not wanted:
        return ""
    return f"{files.relative_path(wanted[0])} is not installed: data_files of setup.py has no line for it"


def _parameter_file(words: Sequence[str], files: WorkspaceFiles) -> str:
    found = files.matching(words[0])
    if not found:
        return f"there is no file {words[0]} in {files.folder}"
    why = ""
    for path in found:
        findings = [each for each in lint_files([path], path) if each.fault == "refused"]
        if findings:
            why = _at_place(findings[0].place, findings[0].line, findings[0].hint or findings[0].subject, files)
            continue
        try:
            read = sections(files.text(path))
        except ValueError as error:
            why = f"{files.relative_path(path)}: {error}"
            continue
        values = {name: _written(place) for section in read for name, place in section.places.items()}
        if not read:
            why = f"{files.relative_path(path)} has no ros__parameters below a node's name"
        elif len(words) > 1 and words[1] not in values:
            why = f"{files.relative_path(path)} gives no {words[1]}{hints.did_you_mean(words[1], values)}"
        elif len(words) > 2 and not _equal(values[words[1]], words[2]):
            why = f"{files.relative_path(path)} gives {words[1]} the value {values[words[1]]}, not {words[2]}"
        else:
            return ""
    return why


def _written(place: Scalar | YamlSequence) -> str:
    return place.text if isinstance(place, Scalar) else "a list"


def _no_findings(words: Sequence[str], files: WorkspaceFiles) -> str:
    found = files.matching(words[0])
    if not found:
        return f"there is no file {words[0]} in {files.folder}"
    findings = lint_files(found)
    if not findings:
        return ""
    first = findings[0]
    return _at_place(first.place, first.line, f"{first.subject}: {first.fault}; {first.hint}", files)


def _at_place(place: str, line: int, text: str, files: WorkspaceFiles) -> str:
    path = Path(place)
    name = files.relative_path(path) if files.folder in path.parents else place
    return f"{name}:{line}: {text}" if line else f"{name}: {text}"


_FILE_CHECKS: Mapping[str, Callable[[Sequence[str], WorkspaceFiles], str]] = {
    "expect-file": _file,
    "expect-entry-point": _entry_point,
    "expect-installed": _installed,
    "expect-parameter-file": _parameter_file,
    "expect-no-findings": _no_findings,
}
