"""Saves the best setting of a tuning as one of the user's profiles."""

from __future__ import annotations

from bot_console.tui.cli.tune.pool import is_file, profile_yaml
from bot_console.tui.console.parameters.file.patch import patched
from bot_console.tui.console.parameters.profile_name_check import profile_name_problem
from bot_console.tui.files.folders import config_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.tuning.job import SettingResult
from bot_console.tui.tuning.specification import TuningSpecification


def save_profile(name: str, specification: TuningSpecification, best: SettingResult) -> str:
    """Save the tuned profile with the best values, and return a message that says where; raises `NotSaved`."""
    if problem := profile_name_problem(name):
        raise NotSaved(problem)
    path = config_folder() / "profiles" / f"{name}.yaml"
    text = profile_yaml(specification.profile)
    if not is_file(specification.profile):
        # The first comment is the title, which says what a profile is for.
        title = f"# {specification.profile}, tuned for {specification.score.text}: score {best.score:.3f}\n"
        text = title + text
    save_file(path, patched(text, specification.values(best.setting)))
    return f"saved as profile {name}: {path}"
