"""Start a command in the way that suits its program."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from bot_console.runtime.children.child_environment import child_environment
from bot_console.runtime.process import current
from bot_console.runtime.process.lockstep.coordinator import coordinator_of
from bot_console.runtime.programs.hints import for_children
from launch.child.child import Child, Output
from launch.child.forked_child import start_forked_child
from launch.child.node_child import start_node_child
from launch.child.os_child import start_os_child
from launch.child.python_program import PythonProgram
from launch.child.stepped_child import start_stepped_child


async def start_child(
    command: Sequence[str],
    *,
    program: PythonProgram | None,
    own_process: bool,
    name: str,
    shell: bool,
    emulate_tty: bool,
    env: Mapping[str, str],
    cwd: str | None,
    output: Output,
) -> Child:
    """Run a command, or the Python program that it names; raises whatever the start raises, mostly `OSError`."""
    env = {**env, **for_children()}
    if program is None or own_process:
        env = child_environment(env)
    if program is None:
        return await start_os_child(command, shell=shell, emulate_tty=emulate_tty, env=env, cwd=cwd, output=output)
    if own_process and (coordinator := coordinator_of(current().clock)) is not None:
        return await start_stepped_child(
            coordinator, program, name, argv=command, env=env, cwd=cwd, emulate_tty=emulate_tty, output=output
        )
    if own_process:
        return await start_forked_child(
            program, name, argv=command, env=env, cwd=cwd, emulate_tty=emulate_tty, output=output
        )
    return start_node_child(program.load(), name, argv=command, env=env, output=output)
