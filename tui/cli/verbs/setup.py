"""`bot-console setup SHELL`: the equivalent of sourcing a ROS installation. Prints shell code, and writes no file."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence

from bot_console.runtime.commands import BIN, COMMAND_VARIABLE, command

HINT = "# For each new shell, put this line into {}: {}"

_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/config.fish"}

_POSIX = """\
export {variable}={command}
export ROS_DISTRO="${{ROS_DISTRO:-jazzy}}" ROS_VERSION=2 ROS_PYTHON_VERSION=3
case ":$PATH:" in *:{rqt}:*) ;; *) export PATH={rqt}:"$PATH" ;; esac
command -v ros2 >/dev/null 2>&1 || export PATH="$PATH":{ros2}
"""

_BASH = """\
_bot_console_complete() {
  local words line="${COMP_LINE:0:COMP_POINT}" IFS=' '
  read -ra words <<<"$line"
  [[ "$line" == *' ' ]] && words+=('')
  local IFS=$'\\n'
  COMPREPLY=($("$BOT_CONSOLE_COMMAND" complete "${words[@]}" 2>/dev/null))
  [[ ${#COMPREPLY[@]} -eq 0 ]] && compopt -o default
  [[ "${COMPREPLY[0]}" == *= ]] && compopt -o nospace
  return 0
}
complete -F _bot_console_complete bot-console
if [[ "$(command -v ros2)" == {ros2}/ros2 ]]; then complete -F _bot_console_complete ros2; fi
"""

_ZSH = """\
_bot_console_complete() {
  local -a found
  found=("${(@f)$("$BOT_CONSOLE_COMMAND" complete "${(@)words[1,CURRENT]}" 2>/dev/null)}")
  local -a joined
  [[ "${found[1]}" == *= ]] && joined=(-S '')
  [[ -n "${found[1]}" ]] && compadd -Q "${joined[@]}" -a found || _files
}
(( ${+functions[compdef]} )) || { autoload -Uz compinit && compinit; }
compdef _bot_console_complete bot-console
if [[ "$(command -v ros2)" == {ros2}/ros2 ]]; then compdef _bot_console_complete ros2; fi
"""

_FISH = """\
set -gx {variable} {command}
set -q ROS_DISTRO; or set -gx ROS_DISTRO jazzy
set -gx ROS_VERSION 2
set -gx ROS_PYTHON_VERSION 3
contains -- {rqt} $PATH; or set -gx PATH {rqt} $PATH
command -q ros2; or set -gx PATH $PATH {ros2}
function __bot_console_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l found ($BOT_CONSOLE_COMMAND complete $words 2>/dev/null)
    if set -q found[1]
        printf '%s\n' $found
    else
        __fish_complete_path (commandline -ct)
    end
end
complete -c bot-console -f -a '(__bot_console_complete)'
test (command -s ros2) = {ros2}/ros2; and complete -c ros2 -f -a '(__bot_console_complete)'
"""


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
    """The code that a shell evaluates."""
    places = {
        "variable": COMMAND_VARIABLE,
        "command": shlex.quote(command()),
        "rqt": shlex.quote(str(BIN / "rqt")),
        "ros2": shlex.quote(str(BIN / "ros2")),
    }
    if shell == "fish":
        return _filled(_FISH, places)
    return _filled(_POSIX.replace("{{", "{").replace("}}", "}"), places) + _filled(
        _BASH if shell == "bash" else _ZSH, places
    )


def evaluation(shell: str) -> str:
    """The line that evaluates the code in a shell."""
    return "bot-console setup fish | source" if shell == "fish" else f'eval "$(bot-console setup {shell})"'


def _filled(text: str, places: dict[str, str]) -> str:
    for name, value in places.items():
        text = text.replace(f"{{{name}}}", value)
    return text


def _usage() -> str:
    lines = "\n".join(f"  {shell.ljust(4)}  {evaluation(shell)}" for shell in _FILES)
    return (
        "usage: bot-console setup bash|zsh|fish\n\n"
        "Prints shell code that makes `ros2` (where there is none), `rqt` and `rqt_*` commands of the shell, with "
        f"completion:\n{lines}"
    )
