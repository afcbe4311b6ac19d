"""Operating system calls about the current process, answered for the node process instead of the real one."""

from __future__ import annotations

import atexit
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

from .. import frames
from ..node.running import running_process
from ..node.thread_state import local
from ..notices import notify

if TYPE_CHECKING:
    from ..roles import Handler

_getpid = os.getpid
_getppid = os.getppid
_kill = os.kill
_exit = os._exit
_abort = os.abort
_chdir = os.chdir
_system = os.system  # pyright: ignore[reportDeprecated] -- node code calls it
_signal = signal.signal
_getsignal = signal.getsignal
_raise_signal = signal.raise_signal
_pause: Callable[[], None] | None = getattr(signal, "pause", None)
_set_wakeup_fd = signal.set_wakeup_fd
_execv = os.execv
_execve = os.execve
_register = atexit.register
_unregister = atexit.unregister


def _in_node() -> bool:
    return local.process.main_state is not None


def getpid() -> int:
    """`os.getpid`: the synthetic pid in a node process."""
    return local.process.pid if _in_node() else _getpid()


def getppid() -> int:
    """`os.getppid`: the real process is the parent of its node processes."""
    return _getpid() if _in_node() else _getppid()


def kill(pid: int, signum: int, /) -> None:
    """`os.kill`, including synthetic pids."""
    process = running_process(pid)
    if process is None:
        _kill(pid, signum)
    elif signum:
        process.send_signal(signum)


def raise_signal(signum: int, /) -> None:
    """`signal.raise_signal`: to the calling node process."""
    if _in_node():
        local.process.send_signal(signum)
    else:
        _raise_signal(signum)


def exit_now(status: int) -> NoReturn:
    """`os._exit`: ends the calling node process alone."""
    if _in_node():
        local.process.die(status & 0xFF)
    _exit(status)


def abort() -> NoReturn:
    """`os.abort`: ends the calling node process alone."""
    if _in_node():
        local.process.die(-signal.SIGABRT)
    _abort()


def chdir(path: Any) -> None:
    """`os.chdir`: takes effect, for all node processes, and is therefore reported."""
    if _in_node():
        notify(
            local.process,
            f"os.chdir({path!r}) in {frames.calling_line()}: nodes share one working directory, "
            "so relative paths of other nodes change, too. Use absolute paths instead",
        )
    _chdir(path)


def system(command: str) -> int:
    """`os.system`, with the environment and output of the calling node process."""
    if not _in_node():
        return _system(command)
    status = subprocess.call(command, shell=True)
    return status << 8 if status >= 0 else -status


def execv(path: Any, arguments: Any) -> NoReturn:
    """`os.execv`: the node process runs the program as a child and ends with it."""
    if _in_node():
        exit_now(subprocess.call(list(arguments), executable=path))
    _execv(path, arguments)


def execve(path: Any, arguments: Any, env: Any) -> NoReturn:
    """`os.execve`: the node process runs the program as a child and ends with it."""
    if _in_node():
        exit_now(subprocess.call(list(arguments), executable=path, env=dict(env)))
    _execve(path, arguments, env)


def pause() -> None:
    """`signal.pause`: waits until the node process has handled a signal."""
    if _in_node():
        local.process.signals.pause()
    elif _pause is not None:
        _pause()


def set_wakeup_fd(fd: int, *, warn_on_full_buffer: bool = True) -> int:
    """`signal.set_wakeup_fd`: each signal to the node process writes its number there."""
    if not _in_node():
        return _set_wakeup_fd(fd, warn_on_full_buffer=warn_on_full_buffer)
    signals = local.process.signals
    before, signals.wakeup_fd = signals.wakeup_fd, fd
    return before


def set_signal_handler(signum: int, handler: Handler) -> Handler:
    """`signal.signal`: sets the handler of the calling node process. Raises `ValueError` outside its main thread."""
    if not _in_node():
        return _signal(signum, handler)  # type: ignore[arg-type] -- a node's handler, checked by the original
    if threading.current_thread() is not threading.main_thread():
        raise ValueError("signal only works in main thread of the main interpreter")
    if not callable(handler) and handler not in (signal.SIG_DFL, signal.SIG_IGN):
        raise TypeError("signal handler must be signal.SIG_IGN, signal.SIG_DFL, or a callable object")
    return local.process.signals.set_handler(int(signum), handler)


def signal_handler(signum: int) -> Handler:
    """`signal.getsignal` of the calling node process."""
    return local.process.signals.handler(int(signum)) if _in_node() else _getsignal(signum)


def unavailable(name: str, call: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap a call that acts on the whole real process: it is reported, then made."""

    def reported(*arguments: Any, **options: Any) -> Any:
        if _in_node():
            notify(
                local.process,
                f"{name}() in {frames.calling_line()} acts on all nodes at once, because they share one process",
            )
        return call(*arguments, **options)

    return reported


def register_exit(function: Callable[..., Any], *arguments: Any, **options: Any) -> Callable[..., Any]:
    """`atexit.register`: calls from the node's own files register for the end of the node process."""
    if not _asked_by_node():
        return _register(function, *arguments, **options)
    local.process.exit_functions.append(partial(function, *arguments, **options))
    return function


def unregister_exit(function: Callable[..., Any]) -> None:
    """`atexit.unregister`."""
    if _in_node():
        registered = local.process.exit_functions
        registered[:] = [entry for entry in registered if entry.func != function]
    _unregister(function)


def _asked_by_node() -> bool:
    """Whether the caller is a file of the node: a library imported by it registers for the whole real process."""
    modules = local.process.modules
    return _in_node() and modules is not None and sys._getframe(2).f_builtins is modules.builtins  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
