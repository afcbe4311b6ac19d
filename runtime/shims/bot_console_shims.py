"""Decides what the ROS names refer to in this interpreter: a real ROS 2 on its path, or the embedded runtime.

The decision is made once, when the first of these names is imported, and applies to all. This file is linked into the
folder of shims; see `runtime/shim_folder.py`.
"""

import os
import sys

try:
    from _thread import allocate_lock  # not `threading`, which would then be imported at every start of an interpreter
except ImportError:
    allocate_lock = __import__("thread").allocate_lock  # Python 2

RUNTIME_VARIABLE = "BOT_CONSOLE_RUNTIME"
"""`embedded` selects the embedded runtime even beside a real ROS 2; `bot-console run` sets it for its children."""
WORKSPACE_VARIABLE = "BOT_CONSOLE_WORKSPACE"
REAL = "real"
EMBEDDED = "embedded"
NEEDED = "{name}: bot-console runs on Python {wanted}, and this is Python {here}: start the program with {interpreter}"
ONLY_EMBEDDED = "{} needs the rclpy of bot-console, and this Python has a real one: set BOT_CONSOLE_RUNTIME=embedded"

_lock = allocate_lock()
_choices = []  # type: list[str]


class OtherPythonError(ImportError):
    """A ROS package is imported by a Python of another version than the embedded runtime is installed in."""


def replace(name):
    """Replace a shim that is just being imported by the package of that name; raises what the import raises."""
    _decide(name)
    _import_again(name)


def choose_embedded(name):
    """Install the embedded runtime for a module that needs it; raises `ImportError` if a real `rclpy` is in use."""
    if _decide(name) != EMBEDDED:
        raise ImportError(ONLY_EMBEDDED.format(name))


def real_rclpy():
    """Return the file of a real `rclpy` on the path; empty if there is none."""
    from importlib.machinery import PathFinder

    path = [each for each in sys.path if not is_shim_folder(each)]
    spec = PathFinder.find_spec("rclpy", path)
    if spec is None or spec.loader is None:
        return ""
    return spec.origin or ""


def is_shim_folder(folder):
    """Whether a folder on the path contains shims, of this or another installation of bot-console."""
    return os.path.lexists(os.path.join(folder, "bot_console_shims.py"))


def _decide(name):
    with _lock:
        if not _choices:
            _choices.append(_chosen(name))
    return _choices[0]


def _real_precedes():
    return sys.version_info[0] > 2 and os.environ.get(RUNTIME_VARIABLE) != EMBEDDED and bool(real_rclpy())


def _chosen(name):
    if _real_precedes():
        sys.path[:] = [each for each in sys.path if not is_shim_folder(each)]
        return REAL
    installed = __import__("bot_console_installation")

    if sys.version_info[:2] != installed.VERSION:
        _refuse(name, installed)
    sys.path.extend(each for each in installed.FOLDERS if each not in sys.path)
    from bot_console.runtime.shimmed_python import take_over

    take_over()
    return EMBEDDED


def _refuse(name, installed):
    """Raise an error that prints as one line if it is not caught."""
    text = NEEDED.format(
        name=name,
        wanted=".".join(str(each) for each in installed.VERSION),
        here="{}.{}".format(*sys.version_info[:2]),
        interpreter=installed.INTERPRETER,
    )
    before = sys.excepthook

    def hook(kind, error, trace):
        if kind is OtherPythonError:
            sys.stderr.write("{}\n".format(error))
        else:
            before(kind, error, trace)

    sys.excepthook = hook
    raise OtherPythonError(text)


def _import_again(name):
    import importlib

    shim = sys.modules.pop(name)
    try:
        importlib.import_module(name)
    except BaseException:
        sys.modules.setdefault(name, shim)  # the interpreter removes it, as after any failed import
        raise


def watch():
    """Make a workspace's packages importable, even if a program imports one of them before any ROS package."""
    if not any(isinstance(each, _WorkspaceFinder) for each in sys.meta_path):
        sys.meta_path.insert(0, _WorkspaceFinder(_is_package_folder))
        sys.meta_path.append(_WorkspaceFinder(_may_be_in_workspace))
        sys.meta_path.append(_PluginFinder())


class _PluginFinder:
    """Lets pytest find our plug-in for launch tests. As it is in no folder, pip does not list it."""

    def find_spec(self, name, path=None, target=None):
        """Find no modules."""

    def find_distributions(self, context=None):
        """Return the distribution with the plug-in, for a search through all of the path; a real ROS 2 has its own."""
        everything = context is None or (context.name is None and context.path is sys.path)
        if everything and not _real_precedes():
            yield _plugin_distribution()


def _plugin_distribution():
    from importlib.metadata import Distribution
    from pathlib import Path

    class Plugin(Distribution):
        def read_text(self, filename):
            return _PLUGIN_FILES.get(filename)

        def locate_file(self, path):
            return Path(path)

    return Plugin()


_PLUGIN_FILES = {
    "METADATA": "Metadata-Version: 2.1\nName: bot-console-launch-tests\nVersion: 1\n",
    "entry_points.txt": "[pytest11]\nbot_console_launch_tests = bot_console_launch_tests\n",
}


class _WorkspaceFinder:
    """Lets the runtime find packages of a workspace: first for names that would be taken for namespace packages, and
    last for names that nothing else provides.
    """

    def __init__(self, may_be):
        self._may_be = may_be

    def find_spec(self, name, path=None, target=None):
        """Return the spec of a workspace's package; None for any other name, after a look at a few files."""
        if path is not None or _choices or not self._may_be(name) or _decide(name) != EMBEDDED:
            return None
        specs = (each.find_spec(name, None) for each in sys.meta_path if not isinstance(each, _WorkspaceFinder))
        return next((each for each in specs if each is not None), None)


def _is_package_folder(name):
    """Whether the working directory has a folder with the sources of a package with this name."""
    return os.path.isfile(os.path.join(name, "package.xml"))


def _may_be_in_workspace(name):
    roots = [os.curdir] + [each for each in os.environ.get(WORKSPACE_VARIABLE, "").split(os.pathsep) if each]
    return any(_may_contain(root, name) for root in roots)


def _may_contain(root, name):
    if os.path.isfile(os.path.join(root, "package.xml")):
        return os.path.basename(os.path.abspath(root)) == name or os.path.isdir(os.path.join(root, name))
    source = os.path.join(root, "src")
    if any(os.path.isfile(os.path.join(each, name, "package.xml")) for each in (root, source)):
        return True
    try:
        folders = os.listdir(source)
    except OSError:
        return False
    return any(os.path.isfile(os.path.join(source, each, name, "package.xml")) for each in folders)


def run_hidden(name):
    """Import the module that the shims' module of this name hides, in its place."""
    own = sys.modules.pop(name)
    left_out = [(place, each) for place, each in enumerate(sys.path) if is_shim_folder(each)]
    sys.path[:] = [each for each in sys.path if not is_shim_folder(each)]
    try:
        __import__(name)
    except ImportError as error:
        if getattr(error, "name", None) != name:
            raise
    finally:
        sys.modules.setdefault(name, own)
        if REAL not in _choices:
            for place, each in left_out:
                sys.path.insert(place, each)


if __name__ == "__main__":  # for `bot-console doctor` and `setup`
    import json

    set_up = any(is_shim_folder(each) for each in sys.path[1:])
    print(json.dumps({"version": sys.version_info[:2], "set_up": set_up, "real": real_rclpy()}))
