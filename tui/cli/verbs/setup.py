"""`bot-console setup SHELL`: the equivalent of sourcing a ROS installation. Prints shell code, and writes no file."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.commands import BIN, COMMAND_VARIABLE, command

HINT = "# To have this in every new shell, add this line to {}: {}"

_SHELL_FOLDER = Path(__file__).resolve().parents[1] / "shell"

_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/config.fish"}

_POSIX = """\
export {variable}={command}
export ROS_DISTRO="${{ROS_DISTRO:-jazzy}}" ROS_VERSION=2 ROS_PYTHON_VERSION=3
case ":$PATH:" in *:{rqt}:*) ;; *) export PATH={rqt}:"$PATH" ;; esac
command -v ros2 >/dev/null 2>&1 || export PATH="$PATH":{ros2}
command -v bot-console >/dev/null 2>&1 || export PATH="$PATH":{own}
"""

_FISH = """\
set -gx {variable} {command}
set -q ROS_DISTRO; or set -gx ROS_DISTRO jazzy
set -gx ROS_VERSION 2
set -gx ROS_PYTHON_VERSION 3
contains -- {rqt} $PATH; or set -gx PATH {rqt} $PATH
command -q ros2; or set -gx PATH $PATH {ros2}
command -q bot-console; or set -gx PATH $PATH {own}
"""

_COMPLETION = {"bash": "bot-console.bash", "zsh": "_bot-console", "fish": "bot-console.fish"}
"""Files in `shell`, which a wheel also installs for the shells."""

_COMPLETE_ROS2 = {
    "bash": 'if [[ "$(command -v ros2)" == {ros2}/ros2 ]]; then complete -F _bot_console_complete ros2; fi\n',
    "zsh": 'if [[ "$(command -v ros2)" == {ros2}/ros2 ]]; then compdef _bot_console_complete ros2; fi\n',
    "fish": "test (command -s ros2) = {ros2}/ros2; and complete -c ros2 -f -a '(__bot_console_complete)'\n",
}


def run(words: Sequence[str]) -> int:
    """Print the code for the named shell; exits with 2 if none is named or it is unknown."""
    if len(words) == 1 and words[0] in ("-h", "--help"):
        print(_usage())
        return 0
    if len(words) != 1 or words[0] not in _FILES:
        print(_usage(), file=sys.stderr)
        return 2
    [shell] = words
    sys.stdout.write(code(shell))
    if sys.stdout.isatty():
        print(HINT.format(_FILES[shell], evaluation(shell)), file=sys.stderr)
    return 0


def code(shell: str) -> str:
    """Return the code that a shell evaluates."""
    environment = _FISH if shell == "fish" else _POSIX
    completion = (_SHELL_FOLDER / _COMPLETION[shell]).read_text(encoding="utf-8")
    places = {
        "variable": COMMAND_VARIABLE,
        "command": shlex.quote(command()),
        "rqt": shlex.quote(str(BIN / "rqt")),
        "ros2": shlex.quote(str(BIN / "ros2")),
        "own": shlex.quote(str(BIN / "bot_console")),
    }
    return environment.format_map(places) + completion + _COMPLETE_ROS2[shell].format_map(places)


def evaluation(shell: str) -> str:
    """Return the line that evaluates the code in a shell; its path is absolute, so that it works in any shell."""
    program = shlex.quote(command())
    return f"{program} setup fish | source" if shell == "fish" else f'eval "$({program} setup {shell})"'


def _usage() -> str:
    lines = "\n".join(f"  {shell.ljust(4)}  {evaluation(shell)}" for shell in _FILES)
    return (
        "usage: bot-console setup bash|zsh|fish\n\n"
        "Prints shell code that makes `ros2` (where there is none), `rqt` and `rqt_*` commands of the shell, with "
        f"completion:\n{lines}"
    )
